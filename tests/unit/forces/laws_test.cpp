// SPDX-License-Identifier: MIT
#include "support/traces.hpp"

#include <tamias2d/base/error.hpp>
#include <tamias2d/forces/force_law.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tamias2d::test {
namespace {

BodyView bodyAt(Position center, DVec2 velocity = {})
{
    BodyView body;
    body.center = center;
    body.velocity = velocity;
    body.mass = 2;
    body.inertia = 3;
    return body;
}

// The force of a law that has a potential is minus its slope; here by central differences.
DVec2 slopeOf(const ForceLaw& law, BodyView body)
{
    const double h = 1e-5;
    const auto at = [&](DVec2 d) {
        BodyView moved = body;
        moved.center = body.center + d;
        return law.potential(moved, 0);
    };
    return {(at({h, 0}) - at({-h, 0})) / (2 * h), (at({0, h}) - at({0, -h})) / (2 * h)};
}

TEST(SpringTo, PullsBackByHookesLawAndBrakes)
{
    TRACES("R2", "T1");
    const ForceLaw law = springTo({1, 2}, 10, 0.5);
    const Wrench w = law.force(bodyAt({4, -2}, {2, 6}), 0);
    EXPECT_DOUBLE_EQ(w.force.x, -10 * 3 - 0.5 * 2);
    EXPECT_DOUBLE_EQ(w.force.y, 10 * 4 - 0.5 * 6);
    EXPECT_EQ(w.torque, 0);
    EXPECT_DOUBLE_EQ(law.potential(bodyAt({4, -2}), 0), 0.5 * 10 * 25);
}

TEST(AttractionTo, FallsWithTheSquareOfTheDistance)
{
    TRACES("T3");
    const ForceLaw law = attractionTo({0, 0}, 9);
    const Wrench w = law.force(bodyAt({3, 4}), 0);  // 5 m away: 9 * 2 / 25 N
    EXPECT_NEAR(w.force.x, -0.72 * 0.6, 1e-15);
    EXPECT_NEAR(w.force.y, -0.72 * 0.8, 1e-15);
    EXPECT_NEAR(law.potential(bodyAt({3, 4}), 0), -3.6, 1e-15);
}

TEST(AttractionTo, StaysANumberOnThePointItself)
{
    TRACES("T3", "R4");
    for (const double softening : {0.0, 0.1}) {
        const Wrench w = attractionTo({1, 1}, 1e9, softening).force(bodyAt({1, 1}), 0);
        EXPECT_EQ(w.force, (DVec2{0, 0})) << softening;
    }
}

TEST(AttractionTo, FadesInsideItsSoftening)
{
    TRACES("T3");
    const auto pull = [](double x) { return -attractionTo({0, 0}, 1, 1).force(bodyAt({x, 0}), 0).force.x; };
    EXPECT_NEAR(pull(0.01), 2 * 0.01, 1e-5);      // linear inside
    EXPECT_NEAR(pull(100), 2 / 1e4, 2 / 1e4 * 2e-4);  // as a mass outside
}

TEST(Laws, WithAPotentialAreItsSlope)
{
    TRACES("DD16");
    const std::vector<ForceLaw> laws = {springTo({1, -1}, 7), attractionTo({-1, 0.5}, 3),
                                        attractionTo({0, 0}, 5, 0.7)};
    for (const ForceLaw& law : laws) {
        for (const Position at : {Position{2, 3}, Position{-0.4, 0.1}, Position{0.2, -5}}) {
            const DVec2 force = law.force(bodyAt(at), 0).force, slope = slopeOf(law, bodyAt(at));
            EXPECT_NEAR(force.x, -slope.x, 1e-7) << law.parameters;
            EXPECT_NEAR(force.y, -slope.y, 1e-7) << law.parameters;
        }
    }
}

TEST(Drag, OpposesTheVelocity)
{
    TRACES("R2", "T1");
    const ForceLaw law = drag(2, 0.5);
    const Wrench w = law.force(bodyAt({}, {3, -4}), 0);  // speed 5: 2 + 2.5 N*s/m
    EXPECT_DOUBLE_EQ(w.force.x, -4.5 * 3);
    EXPECT_DOUBLE_EQ(w.force.y, 4.5 * 4);
    EXPECT_FALSE(law.potential) << "what drag takes does not come back";
}

TEST(TorsionSpring, TurnsTheShortWayRound)
{
    TRACES("R2", "T4");
    const ForceLaw law = torsionSpring(0.1, 10, 2);
    BodyView body = bodyAt({});
    body.angle = kTwoPi - 0.2;
    EXPECT_NEAR(law.force(body, 0).torque, 10 * 0.3, 1e-13);
    EXPECT_NEAR(law.potential(body, 0), 5 * 0.09, 1e-13);
    body.angle = 0.6;
    body.spin = 1;
    EXPECT_NEAR(law.force(body, 0).torque, -10 * 0.5 - 2, 1e-13);
}

TEST(Laws, WriteTheirParametersForSceneFiles)
{
    TRACES("R2");
    EXPECT_EQ(springTo({0, -1.5}, 10).parameters,
              R"({"law":"springTo","point":[0,-1.5],"stiffness":10,"damping":0})");
    EXPECT_EQ(attractionTo({1, 2}, 1e14, 0.1).parameters,
              R"({"law":"attractionTo","point":[1,2],"mu":1e+14,"softening":0.1})");
    EXPECT_EQ(drag(0.1).parameters, R"({"law":"drag","linear":0.1,"quadratic":0})");
    EXPECT_EQ(torsionSpring(1, 2, 3).parameters,
              R"({"law":"torsionSpring","angle":1,"stiffness":2,"damping":3})");
}

TEST(Laws, RefuseBadParametersByName)
{
    TRACES("R4");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const std::vector<std::pair<std::function<void()>, std::string>> cases = {
        {[=] { springTo({nan, 0}, 1); }, "springTo.point = (nan, 0): must be finite"},
        {[=] { springTo({}, -1); }, "springTo.stiffness = -1: must be finite and >= 0 N/m"},
        {[=] { springTo({}, 1, inf); }, "springTo.damping = inf: must be finite and >= 0 N*s/m"},
        {[=] { attractionTo({}, nan); }, "attractionTo.mu = nan: must be finite"},
        {[=] { attractionTo({}, 1, -0.1); }, "attractionTo.softening = -0.1: must be finite and >= 0 m"},
        {[=] { drag(-2); }, "drag.linear = -2: must be finite and >= 0 N*s/m"},
        {[=] { drag(0, nan); }, "drag.quadratic = nan: must be finite and >= 0 N*s^2/m^2"},
        {[=] { torsionSpring(inf, 1); }, "torsionSpring.angle = inf: must be finite"},
        {[=] { torsionSpring(0, nan); }, "torsionSpring.stiffness = nan: must be finite and >= 0 N*m/rad"},
    };
    for (const auto& [call, text] : cases) {
        try {
            call();
            ADD_FAILURE() << "accepted, instead of: " << text;
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), text);
        }
    }
}

}  // namespace
}  // namespace tamias2d::test
