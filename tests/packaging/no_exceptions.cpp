// SPDX-License-Identifier: MIT
// TRACES("ADR1", "ADR12")
// Without exceptions a wrong input reaches the handler, the call does nothing, and the world is as it was.

#include <tamias2d/tamias2d.hpp>

#include <cstdio>
#include <limits>
#include <string>

using namespace tamias2d;

namespace {

int refusals = 0;
std::string lastField;

void remember(const InputError& error)
{
    ++refusals;
    lastField = error.field;
}

int faults = 0;

void expect(bool held, const char* claim)
{
    if (held) return;
    ++faults;
    std::printf("not so: %s (refusals %d, last field %s)\n", claim, refusals, lastField.c_str());
}

}  // namespace

int main()
{
    static_assert(!TAMIAS_HAS_EXCEPTIONS);
    setErrorHandler(remember);

    World world;
    Body ball = world.createBody({.position = {0, 10}});
    ball.createShape({.geometry = Circle{}});
    const auto before = world.stateHash();

    const Shape refused = ball.createShape({.geometry = Circle{}, .material = {.restitution = real(1.1)}});
    expect(refusals == 1 && lastField.find("restitution") != std::string::npos,
           "C_R = 1.1 is refused by name");
    expect(refused.id().isNull(), "a refused shape is a null handle");
    ball.setLinearVelocity({std::numeric_limits<real>::quiet_NaN(), 0});
    expect(refusals == 2, "a velocity that is no number is refused");
    Body{}.setAngularVelocity(1);
    expect(refusals == 3, "a null handle is refused");
    expect(world.stateHash() == before, "nothing has changed");

    for (int i = 0; i < 60; ++i) world.step();
    expect(ball.position().y < 6, "the world still runs");
    return faults;
}
