// SPDX-License-Identifier: MIT
// Joints under loads many times their bodies' masses: they hold, keep energy and momentum, and find no end.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

// Chains here touch nothing: what is seen is the joints.
void keepApart(World& world)
{
    for (const BodyId id : world.bodies())
        for (Shape shape : world.body(id).shapes()) shape.setFilter({1, 1, -1});
}

double sumOfErrors(const std::vector<Joint>& joints)
{
    double sum = 0;
    for (const Joint& joint : joints) sum += static_cast<double>(joint.reading().error);
    return sum;
}

// Links of 0.5 m, level, from a static pivot, and a disc of `ratio` times a link's mass at the end.
struct Chain {
    World world;
    std::vector<Joint> joints;
    double length = 0;   // [m]
    double mass = 0;     // [kg]

    Chain(int links, double ratio)
    {
        constexpr double kLink = 0.5, kRadius = 0.3;
        length = links * kLink;
        Body last = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
        for (int i = 0; i < links; ++i) {
            Body link = addBox(world, {kLink * (i + 0.5), 0}, kLink, 0.1);
            joints.push_back(world.createJoint(revoluteAt(last, link, {kLink * i, 0})));
            last = link;
            mass += static_cast<double>(link.mass());
        }
        const double heavy = ratio * static_cast<double>(last.mass());
        Body load =
            addDisc(world, {length + kRadius, 0}, kRadius, {.density = heavy / (kPi * kRadius * kRadius)});
        joints.push_back(world.createJoint(revoluteAt(last, load, {length, 0})));
        mass += heavy;
        keepApart(world);
    }
};

struct ChainCase {
    int links;
    double ratio, allowed;
};
void PrintTo(const ChainCase& c, std::ostream* out)
{
    *out << c.links << " links, end load " << c.ratio << " of one";
}

// 20 s, without a stretch of more than `allowed` of the length, gaining no energy.
template <class AnyChain>
void expectNoStretchInASwing(AnyChain& chain, double allowed)
{
    double worst = 0, lowest = chain.world.energy().total(), rise = 0;
    std::uint32_t fallbacks = 0;
    runSeconds(chain.world, 20, 60, 4, [&] {
        worst = std::max(worst, sumOfErrors(chain.joints) / chain.length);
        const double energy = chain.world.energy().total();
        lowest = std::min(lowest, energy);
        rise = std::max(rise, energy - lowest);
        fallbacks += chain.world.lastReport().stiffFallbacks;
    });
    EXPECT_LT(worst, allowed);
    EXPECT_LT(rise / (chain.mass * 9.81), 0.1);  // as a lift of all of it [m]; it falls by several meters
    EXPECT_EQ(fallbacks, 0u);
}

class ChainOf : public testing::TestWithParam<ChainCase> {};

TEST_P(ChainOf, DoesNotStretchWhileItSwingsFromLevel)
{
    TRACES("LC3", "NFR2");
    Chain chain(GetParam().links, GetParam().ratio);
    expectNoStretchInASwing(chain, GetParam().allowed);
}

INSTANTIATE_TEST_SUITE_P(Joints, ChainOf,
                         testing::Values(ChainCase{20, 1, 0.0025}, ChainCase{20, 100, 0.0015},
                                         ChainCase{20, 1000, 0.0015}, ChainCase{20, 10000, 0.0015},
                                         ChainCase{50, 1, 0.007}, ChainCase{50, 100, 0.0015},
                                         ChainCase{50, 1000, 0.0015}, ChainCase{50, 10000, 0.0015}));

// Discs 0.5 m apart, level, from a static hook, tied by rods or ropes, and one of `ratio` times a disc's mass
// at the end.
struct TiedDiscs {
    World world;
    std::vector<Joint> joints;
    double length = 0;  // [m]
    double mass = 0;  // [kg]

    TiedDiscs(int links, double ratio, bool ropes)
    {
        constexpr double kLink = 0.5, kRadius = 0.1, kLoad = 0.3;
        length = links * kLink;
        Body last = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
        for (int i = 1; i <= links; ++i) {
            const double thin = kRadius * kRadius / (kLoad * kLoad);
            Body disc = i < links ? addDisc(world, {i * kLink, 0}, kRadius)
                                  : addDisc(world, {length, 0}, kLoad, {.density = ratio * thin});
            JointDef tie = rodBetween(last, disc, {(i - 1) * kLink, 0}, {i * kLink, 0});
            if (ropes)
                std::get<DistanceJoint>(tie.kind).limits = JointLimits{.lower = 0, .upper = toReal(kLink)};
            joints.push_back(world.createJoint(tie));
            last = disc;
            mass += static_cast<double>(disc.mass());
        }
        keepApart(world);
    }
};

struct TiedCase {
    int links;
    double ratio;
    bool ropes;
};
void PrintTo(const TiedCase& c, std::ostream* out)
{
    *out << c.links << (c.ropes ? " ropes" : " rods") << ", end load " << c.ratio << " of a disc";
}

class ChainOfTies : public testing::TestWithParam<TiedCase> {};

TEST_P(ChainOfTies, DoesNotStretchWhileItSwingsFromLevel)
{
    TRACES("LC3", "NFR2");
    TiedDiscs chain(GetParam().links, GetParam().ratio, GetParam().ropes);
    expectNoStretchInASwing(chain, 0.0015);
}

INSTANTIATE_TEST_SUITE_P(Joints, ChainOfTies,
                         testing::Values(TiedCase{20, 1, false}, TiedCase{20, 100, false},
                                         TiedCase{20, 1000, false}, TiedCase{20, 10000, false},
                                         TiedCase{50, 1, false}, TiedCase{50, 100, false},
                                         TiedCase{50, 1000, false}, TiedCase{50, 10000, false},
                                         TiedCase{20, 1, true}, TiedCase{20, 100, true},
                                         TiedCase{20, 1000, true}, TiedCase{20, 10000, true},
                                         TiedCase{50, 1, true}, TiedCase{50, 100, true},
                                         TiedCase{50, 1000, true}, TiedCase{50, 10000, true}));

TEST(StiffJoints, ATrussOfFiveByFiveNodesBearsAThousandTimesOneOfThem)
{
    TRACES("LC3", "NFR2");
    World world;
    std::vector<Joint> joints;
    std::vector<Body> nodes;  // column by column; the first one is a wall
    constexpr std::size_t kSide = 5;
    const auto tie = [&](std::size_t i, std::size_t k) {
        if (nodes[i].type() == BodyType::Static && nodes[k].type() == BodyType::Static) return;
        joints.push_back(
            world.createJoint(rodBetween(nodes[i], nodes[k], nodes[i].position(), nodes[k].position())));
    };
    for (std::size_t i = 0; i < kSide * kSide; ++i) {
        const bool isWall = i < kSide, isTip = i == (kSide - 1) * kSide;
        nodes.push_back(addDisc(
            world, {static_cast<double>(i / kSide), static_cast<double>(i % kSide)}, 0.1,
            {.type = isWall ? BodyType::Static : BodyType::Dynamic, .density = isTip ? 1000.0 : 1.0}));
    }
    for (std::size_t x = 0; x < kSide; ++x)
        for (std::size_t y = 0; y < kSide; ++y) {
            const std::size_t self = kSide * x + y;
            if (y + 1 < kSide) tie(self, self + 1);
            if (x + 1 == kSide) continue;
            tie(self, self + kSide);
            if (y + 1 < kSide) tie(self, self + kSide + 1), tie(self + 1, self + kSide);  // both: redundant
        }
    keepApart(world);
    double worst = 0;
    std::uint32_t stiff = 0;
    runSeconds(world, 20, 60, 4, [&] {
        worst = std::max(worst, sumOfErrors(joints) / (kSide - 1));
        stiff = std::max(stiff, world.lastReport().stiffGroups);
    });
    EXPECT_LT(worst, 1e-4);
    EXPECT_EQ(stiff, 1u);
    EXPECT_LT(length(nodes[(kSide - 1) * kSide].position() - Position{4, 0}), 1e-3);
}

// Eight links that fall, each turned by 0.05 rad beyond its limit at the start, in turn to either side.
TEST(StiffJoints, AnErrorOfTheStartIsNoLoad)
{
    TRACES("LC3");
    World world;
    std::vector<Joint> joints;
    Body last = addBox(world, {0.25, 0}, 0.5, 0.1);
    for (int i = 1; i < 8; ++i) {
        Body link = addBox(world, {0.5 * i + 0.25, 0}, 0.5, 0.1);
        JointDef hinge = revoluteAt(last, link, {0.5 * i, 0});
        std::get<RevoluteJoint>(hinge.kind).limits =
            i % 2 == 0 ? JointLimits{toReal(0.05), 1} : JointLimits{-1, toReal(-0.05)};
        joints.push_back(world.createJoint(hinge));
        last = link;
    }
    keepApart(world);
    std::uint32_t stiff = 0;
    runSeconds(world, 1, 60, 4, [&] { stiff += world.lastReport().stiffGroups; });
    EXPECT_EQ(stiff, 0u);
    for (const Joint& joint : joints) {
        EXPECT_LT(joint.reading().angularError, toReal(1e-3));
        EXPECT_LT(joint.reading().error, toReal(1e-4));
    }
}

TEST(StiffJoints, ABeamOfWeldsBearsAThousandTimesItsPart)
{
    TRACES("LC3", "NFR2");
    World world;
    Body last = addBox(world, {-0.5, 0}, 1, 1, {.type = BodyType::Static});
    std::vector<Joint> joints;
    for (int i = 0; i < 10; ++i) {
        Body part = addBox(world, {0.5 * i + 0.25, 0}, 0.5, 0.2);
        joints.push_back(world.createJoint(weldAt(last, part, {0.5 * i, 0})));
        last = part;
    }
    Body load = addBox(world, {5.5, 0}, 1, 1, {.density = 100});  // 100 kg on parts of 0.1 kg
    joints.push_back(world.createJoint(weldAt(last, load, {5, 0})));
    keepApart(world);
    double worst = 0;
    runSeconds(world, 5, 60, 4, [&] { worst = std::max(worst, sumOfErrors(joints) / 5); });
    EXPECT_LT(worst, 1e-4);
    EXPECT_NEAR(centerOf(load).y, 0, 5e-3);
    const double weight = 101 * 9.81, lever = (100 * 5.5 + 1 * 2.5) / 101;
    EXPECT_LT(relativeError(static_cast<double>(joints[0].reading().force.y), weight), 0.01);
    EXPECT_LT(relativeError(static_cast<double>(joints[0].reading().torque), weight * lever), 0.01);
}

TEST(StiffJoints, AFourBarLinkageTurnsUnderAHeavyCoupler)
{
    TRACES("LC3", "NFR2");
    World world;
    // Crank 1 m, coupler 3 m, rocker 2 m on a base of 3 m: the crank may go round, and no two bars ever lie
    // in line with the base, where a parallelogram would have two ways to go on.
    const Position knee{2.830948, 1.992844};  // 3 m from the crank's end, 2 m from the rocker's foot
    const double couplerAngle = 0.337330, rockerAngle = 0.084627;
    Body base = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body crank = addBox(world, {0, 0.5}, 0.1, 1);
    Body rocker = addBox(world, {(3 + knee.x) / 2, knee.y / 2}, 0.1, 2, {.angle = rockerAngle});
    Body coupler =
        addBox(world, {knee.x / 2, (1 + knee.y) / 2}, 3, 0.1, {.angle = couplerAngle, .density = 100.0 / 3});
    const std::vector<Joint> joints = {world.createJoint(revoluteAt(base, crank, {0, 0})),
                                       world.createJoint(revoluteAt(crank, coupler, {0, 1})),
                                       world.createJoint(revoluteAt(coupler, rocker, knee)),
                                       world.createJoint(revoluteAt(base, rocker, {3, 0}))};
    keepApart(world);
    double worst = 0;
    runSeconds(world, 20, 60, 4, [&] { worst = std::max(worst, sumOfErrors(joints) / 5); });
    EXPECT_LT(worst, 1e-4);
}

TEST(StiffJoints, ADoublePendulumKeepsItsEnergy)
{
    TRACES("LC3", "NFR2", "DD15", "DD16");
    World world;
    Body pivot = addDisc(world, {0, 0}, 0.1, {.type = BodyType::Static});
    Body upper = addBox(world, {0.5, 0}, 1, 0.1), lower = addBox(world, {1.5, 0}, 1, 0.1);
    world.createJoint(revoluteAt(pivot, upper, {0, 0}));
    world.createJoint(revoluteAt(upper, lower, {1, 0}));
    keepApart(world);
    const double start = world.energy().total();
    double drift = 0;
    runSeconds(world, 60, 60, 4, [&] { drift = std::max(drift, std::abs(world.energy().total() - start)); });
    EXPECT_LT(drift / (static_cast<double>(upper.mass()) * 9.81 * 2), 0.01);
}

TEST(StiffJoints, AFreeChainKeepsMomentumAndEnergy)
{
    TRACES("LC3", "GD1", "NFR2");
    World world(weightless());
    Body last;
    for (int i = 0; i < 20; ++i) {
        const double x = 0.5 * i - 4.75;
        Body link = addBox(world, {x, 0}, 0.5, 0.1, {.velocity = vec(0.3, 2 * x), .spin = 2});
        if (i > 0) world.createJoint(revoluteAt(last, link, {x - 0.25, 0}));
        last = link;
    }
    last.applyImpulseToCenter(vec(0, 0.02));  // it does not stay straight
    keepApart(world);
    const Momentum before = world.momentum();
    const double start = world.energy().total();
    runSeconds(world, 20);
    const Momentum after = world.momentum();
    EXPECT_LT(relativeError(after.linear, before.linear), byPrecision(1e-6, 1e-5));
    EXPECT_LT(relativeError(after.angular, before.angular), byPrecision(1e-4, 2e-4));
    EXPECT_LT(relativeError(world.energy().total(), start), 1e-3);
}

TEST(StiffJoints, AStiffGroupBesideOthersMovesAsIfAlone)
{
    TRACES("LC3", "ADR6");
    const auto endOf = [](bool accompanied) {
        World world;
        Body last = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
        for (int i = 0; i < 8; ++i) {
            Body link = addBox(world, {0.5 * i + 0.25, 0}, 0.5, 0.1, {.density = i == 7 ? 1000.0 : 1.0});
            world.createJoint(revoluteAt(last, link, {0.5 * i, 0}));
            last = link;
        }
        if (accompanied) {
            Body hook = addDisc(world, {50, 0}, 0.05, {.type = BodyType::Static});
            for (int i = 0; i < 6; ++i) {
                Body bob = addDisc(world, {51.0 + i, 0}, 0.2, {.density = i == 5 ? 500.0 : 1.0});
                world.createJoint(revoluteAt(hook, bob, {50.5 + i, 0}));
                hook = bob;
            }
        }
        keepApart(world);
        runSeconds(world, 5);
        return last.transform();
    };
    const Transform alone = endOf(false), accompanied = endOf(true);
    EXPECT_EQ(alone.position, accompanied.position);
    EXPECT_EQ(alone.angle, accompanied.angle);
}

TEST(StiffJoints, RedundantAndContradictoryJointsDoNoHarm)
{
    TRACES("LC3", "R4");
    World world;
    Body base = addBox(world, {0, 0}, 1, 1, {.type = BodyType::Static});
    Body box = addBox(world, {2, 0}, 1, 1), other = addBox(world, {4, 0}, 1, 1, {.density = 50});
    for (int i = 0; i < 3; ++i) {
        world.createJoint(weldAt(base, box, {1, 0}));
        world.createJoint(weldAt(box, other, {3, 0}));
        world.createJoint(revoluteAt(base, other, {2, 0}));
    }
    JointDef wrong = revoluteAt(base, other, {2, 0});
    std::get<RevoluteJoint>(wrong.kind).anchorB = vec(-2, 0.3);  // 0.3 m beside the others' place
    world.createJoint(wrong);
    const RunTotals totals = runSeconds(world, 5);
    EXPECT_EQ(totals.faults, 0u);
    EXPECT_LT(fastestBody(world), 1);
    EXPECT_LT(length(centerOf(other) - DVec2{4, 0}), 0.5);
}

}  // namespace
}  // namespace tamias2d
