// SPDX-License-Identifier: MIT
// What joints hold falls asleep and wakes together.
#include <support/run.hpp>
#include <support/scenes.hpp>

#include <functional>

namespace tamias2d::test {
namespace {

// Three links that hang on a static hook, asleep.
struct Chain {
    World world;
    Body hook = addBox(world, {0, 10}, 1, 1, {.type = BodyType::Static});
    std::vector<Body> links;
    std::vector<Joint> joints;

    Chain()
    {
        Body above = hook;
        for (int i = 0; i < 3; ++i) {
            BodyDef def;
            def.position = {0, 9.0 - i};
            def.linearDamping = 3;
            def.angularDamping = 3;
            Body link = world.createBody(def);
            link.createShape({.geometry = makeBox(toReal(0.2), 1), .filter = {.mask = 0}});
            joints.push_back(world.createJoint(revoluteAt(above, link, {0, 9.5 - i})));
            links.push_back(link);
            above = link;
        }
        runSeconds(world, 4);
        EXPECT_EQ(world.lastReport().asleep, 3u);
    }
    bool areAwake() const { return links[0].isAwake() && links[1].isAwake() && links[2].isAwake(); }
};

TEST(JointSleep, ComesToAChainThatHangsStill)
{
    TRACES("R8", "ADR25");
    Chain chain;
    const double force = chain.joints[0].reading().force.y;
    runSeconds(chain.world, 1);
    EXPECT_EQ(chain.world.lastReport().asleep, 3u);
    EXPECT_EQ(chain.joints[0].reading().force.y, force) << "it goes on to bear what it bore";
    chain.links[2].wake();
    EXPECT_TRUE(chain.areAwake());
    const Position before = chain.links[2].position();
    runSeconds(chain.world, 0.1);
    EXPECT_LE(length(chain.links[2].position() - before), 1e-4) << "without a jolt";
}

TEST(JointSleep, EndsWithEveryChangeOfAJointAndOfWhatItHangsOn)
{
    TRACES("R8", "ADR25");
    const std::vector<std::pair<const char*, std::function<void(Chain&)>>> causes = {
        {"destroyed", [](Chain& c) { c.joints[0].destroy(); }},
        {"disabled", [](Chain& c) { c.joints[0].setEnabled(false); }},
        {"another kind", [](Chain& c) { c.joints[0].setKind(WeldJoint{}); }},
        {"another joint", [](Chain& c) { c.world.createJoint(revoluteAt(c.hook, c.links[2], {0, 7})); }},
        {"hook moved", [](Chain& c) { c.hook.setTransform({1, 10}, 0); }},
        {"hook gone", [](Chain& c) { c.hook.destroy(); }},
        {"hook disabled", [](Chain& c) { c.hook.setEnabled(false); }},
        {"hook dynamic", [](Chain& c) { c.hook.setType(BodyType::Dynamic); }},
    };
    for (const auto& [name, act] : causes) {
        Chain chain;
        act(chain);
        EXPECT_TRUE(chain.areAwake()) << name;
        chain.world.step();
    }
    Chain chain;
    const double before = chain.links[0].position().y;
    chain.joints[0].destroy();
    runSeconds(chain.world, 0.25);
    EXPECT_GT(before - chain.links[0].position().y, 0.1) << "it falls";
}

TEST(JointSleep, EndsWhenItsGroundBeginsToMove)
{
    TRACES("R8", "ADR25");
    Chain chain;
    chain.hook.setType(BodyType::Kinematic);
    runSeconds(chain.world, 4);
    EXPECT_EQ(chain.world.lastReport().asleep, 3u);
    chain.hook.setLinearVelocity(vec(0, 1));
    const double before = chain.links[2].position().y;
    runSeconds(chain.world, 1);
    EXPECT_TRUE(chain.areAwake());
    EXPECT_NEAR(chain.links[2].position().y - before, 1, 0.05);
}

TEST(JointSleep, EndsInMidStepForAnImpactThatNobodyCouldForesee)
{
    TRACES("GD1", "R8", "ADR25");
    Chain chain;
    for (Body link : chain.links) link.shapes().front().setFilter({});
    for (Joint joint : chain.joints) joint.setCollideConnected(false);
    runSeconds(chain.world, 4);
    ASSERT_EQ(chain.world.lastReport().asleep, 3u);
    const Options elastic{.restitution = 1};
    Options fast = elastic;
    fast.velocity = vec(600, 0);
    addDisc(chain.world, {-5, 7}, 0.2, fast);
    Body second = addDisc(chain.world, {-3, 7}, 0.2, elastic);
    EXPECT_TRUE(second.sleep());
    chain.world.step();
    EXPECT_TRUE(chain.areAwake());
    for (const Joint& joint : chain.joints)
        EXPECT_LE(length(joint.anchorA() - joint.anchorB()), 0.05) << "the joints held in the same step";
}

}  // namespace
}  // namespace tamias2d::test
