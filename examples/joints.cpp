#include <tamias2d/tamias2d.hpp>

#include <cstdio>

int main()
{
    using namespace tamias2d;
    World world;
    Body post = world.createBody({.type = BodyType::Static});
    Body arm = world.createBody({.position = {1, 0}});
    arm.createShape({.geometry = makeBox(2, real(0.2))});

    // Bodies as they stand, a place in the world: the joint's angle counts from here.
    JointDef def = revoluteAt(post, arm, {0, 0});
    std::get<RevoluteJoint>(def.kind).limits = JointLimits{.lower = real(-1.2), .upper = real(0.5)};
    def.breaking.force = 500;
    Joint hinge = world.createJoint(def);

    for (int step = 0; step < 120; ++step) world.step();
    const JointReading now = hinge.reading();
    std::printf("at %.2f rad, bears %.1f N, at its lower limit: %s\n", now.position,
                static_cast<double>(now.force.y), now.limit == LimitState::AtLower ? "yes" : "no");
}
