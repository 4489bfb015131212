// SPDX-License-Identifier: MIT
// A long random script: anything may be created, destroyed, moved, changed and stepped at any time. For every
// pair of shapes the events form (begin, end)*, touching() and contacts() agree with them, and the same
// script gives the same bits [R1, R7].
#include "support/script.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace tamias2d {
namespace {

using namespace test;

using ShapeIds = std::pair<ShapeId, ShapeId>;

class Script final : public RandomScript {
public:
    using RandomScript::RandomScript;

    int begins() const { return begins_; }
    int ends() const { return ends_; }

private:
    void afterStep(const StepReport& report) override
    {
        follow(world_.events());
        compare(report);
    }

    void follow(const StepEvents& events)
    {
        const auto inOrder = [](const TouchEvent& a, const TouchEvent& b) {
            return ShapeIds{a.shapeA, a.shapeB} < ShapeIds{b.shapeA, b.shapeB};
        };
        EXPECT_TRUE(std::is_sorted(events.begins.begin(), events.begins.end(), inOrder));
        EXPECT_TRUE(std::is_sorted(events.ends.begin(), events.ends.end(), inOrder));
        for (const TouchEvent& e : events.ends) {
            ++ends_;
            EXPECT_EQ(touching_.erase({e.shapeA, e.shapeB}), 1u) << "an end without a begin";
        }
        for (const TouchEvent& e : events.begins) {
            ++begins_;
            EXPECT_TRUE(touching_.insert({e.shapeA, e.shapeB}).second) << "a second begin without an end";
            EXPECT_EQ(world_.shape(e.shapeA).body(), e.bodyA);
            EXPECT_EQ(world_.shape(e.shapeB).body(), e.bodyB);
        }
    }

    void compare(const StepReport& report)
    {
        std::set<ShapeIds> seen;
        for (const ContactView& contact : world_.contacts()) {
            if (contact.touching) seen.insert({contact.shapeA, contact.shapeB});
            EXPECT_TRUE(world_.body(contact.bodyA).isEnabled() && world_.body(contact.bodyB).isEnabled());
        }
        EXPECT_EQ(seen, touching_) << "contacts() against the events";
        EXPECT_EQ(report.touching, touching_.size());
        for (const ShapeIds& pair : touching_) {
            ASSERT_TRUE(world_.findShape(pair.first) && world_.findShape(pair.second))
                << "a destroyed shape touches";
            EXPECT_TRUE(world_.touching(pair.first, pair.second));
            EXPECT_TRUE(world_.touching(world_.shape(pair.second).body(), world_.shape(pair.first).body()));
        }
        const std::vector<BodyId> ids = world_.bodies();
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const Body body = world_.body(ids[i]);
            EXPECT_TRUE(isFinite(body.position()) && isFinite(body.linearVelocity()));
            const BodyId other = ids[static_cast<std::size_t>(below(static_cast<int>(ids.size())))];
            EXPECT_EQ(world_.touching(ids[i], other), touch(ids[i], other));
        }
    }

    bool touch(BodyId a, BodyId b)
    {
        return std::any_of(touching_.begin(), touching_.end(), [&](const ShapeIds& pair) {
            const BodyId x = world_.shape(pair.first).body(), y = world_.shape(pair.second).body();
            return (x == a && y == b) || (x == b && y == a);
        });
    }

    std::set<ShapeIds> touching_;
    int begins_ = 0, ends_ = 0;
};

TEST(Script, OfTenThousandOperationsKeepsEventsAndTouchesInAgreement)
{
    TRACES("R1", "R7", "R4", "ADR13");
    Script script(1);
    script.run(10000);
    EXPECT_GT(script.steps(), 3000);
    EXPECT_GT(script.begins(), 1000);
    EXPECT_GT(script.ends(), 1000);
}

TEST(Script, GivesTheSameBitsWhenItIsPlayedAgain)
{
    TRACES("R1", "ADR6");
    for (const std::uint32_t seed : {2u, 3u, 4u}) {
        Script first(seed), second(seed);
        first.run(2000);
        second.run(2000);
        EXPECT_EQ(first.world().stateHash(), second.world().stateHash()) << "seed " << seed;
    }
}

}  // namespace
}  // namespace tamias2d
