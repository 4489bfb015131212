// SPDX-License-Identifier: MIT
#pragma once

#include "support/build.hpp"
#include "support/describe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

// What the tests of bad input share: values that no quantity may take, a world with one of everything, and
// the demand that a refusal names field, value and rule and leaves that world as it was [R4].
namespace tamias2d::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Values = std::vector<double>;
inline const Values kNotFinite = {kNaN, kInfinity, -kInfinity};

inline Values notFiniteAnd(std::initializer_list<double> more)
{
    Values all = kNotFinite;
    all.insert(all.end(), more);
    return all;
}
inline const Values kNegative = notFiniteAnd({-1, -1e-30});
inline const Values kNotPositive = notFiniteAnd({-1, -1e-30, 0});
inline const Values kNoSize = notFiniteAnd({-1, 0, 0.9e-6, 1.1e6});
inline const Values kNoRounding = notFiniteAnd({-1, -1e-6, 1.1e6});
inline const Values kNoPlace = notFiniteAnd({1.01e9, -1.01e9, 1e300});
inline const Values kNoSpeed = notFiniteAnd({1.01e6, -1.01e6, 1e30});
inline const Values kNoRestitution = notFiniteAnd({-0.1, 1.1, -1e-6, 1.0001, 2});

/// A world with one of everything, a second world, and handles of things that are gone.
struct Everything {
    World world, other;
    Body ground = addGround(world, 0, 20);
    Body box = addBox(world, {0, 0.501}, 1, 1, {.velocity = vec(0.5, 0)});
    Body disc = addDisc(world, {3, 2}, 0.5, {.spin = 1});
    Body platform = addBox(world, {-5, 1}, 2, 0.2, {.type = BodyType::Kinematic, .velocity = vec(0, 1)});
    Body dead = addDisc(world, {5, 5}, 0.5);
    Body foreign = addDisc(other, {0, 0}, 0.5);
    Shape boxShape = box.shapes().front();
    Shape deadShape = dead.shapes().front();
    Shape foreignShape = foreign.shapes().front();
    ForceLawId law = world.addForceLaw(drag(0.1));
    ForceLawId deadLaw = world.addForceLaw(drag(0.2));

    Everything()
    {
        world.step();
        other.step();
        dead.destroy();
        world.removeForceLaw(deadLaw);
        box.addForce({.force = vec(1, 0)});
        box.applyForceToCenter(vec(0, 2));
    }
};

inline bool containsIgnoringCase(std::string text, std::string part)
{
    const auto lower = [](std::string& s) {
        std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::tolower(c); });
    };
    lower(text);
    lower(part);
    return text.find(part) != std::string::npos;
}

/// The call must raise InputError whose field contains `field`, and say all it promises.
template <class Call>
void expectInputError(const std::string& what, const std::string& field, Call&& call)
{
    try {
        call();
        ADD_FAILURE() << what << ": accepted";
    } catch (const InputError& error) {
        EXPECT_TRUE(containsIgnoringCase(error.field, field))
            << what << ": the field should name \"" << field << "\": " << error.what();
        EXPECT_FALSE(error.rule.empty()) << what << ": " << error.what();
        EXPECT_FALSE(error.value.empty()) << what << ": " << error.what();
        const std::string text = error.what();
        EXPECT_NE(text.find(error.field), std::string::npos) << text;
        EXPECT_NE(text.find(error.rule), std::string::npos) << text;
    } catch (const std::exception& error) {
        ADD_FAILURE() << what << ": raised something else: " << error.what();
    }
}

/// Likewise, and the world must be as it was: every definition, and every bit of its state.
template <class Call>
void expectRefused(Everything& all, const std::string& what, const std::string& field, Call&& call)
{
    const std::uint64_t hash = all.world.stateHash();
    const std::string text = describe(all.world);
    expectInputError(what, field, call);
    EXPECT_EQ(all.world.stateHash(), hash) << what << ": changed the state";
    EXPECT_EQ(describe(all.world), text) << what << ": changed a definition";
}

/// One number of a definition or call: each of `values`, put in by `put`, must be refused.
template <class Target>
struct BadNumber {
    const char* field;
    Values values;
    void (*put)(Target&, double);
};

template <class Target>
std::string caseName(const BadNumber<Target>& entry, double value)
{
    return std::string(entry.field) + " = " + std::to_string(value);
}

}  // namespace tamias2d::test
