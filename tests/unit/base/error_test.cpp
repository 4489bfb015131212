// SPDX-License-Identifier: MIT
#include "base/check.hpp"
#include "support/traces.hpp"

#include <tamias2d/math/transform.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace tamias2d::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(InputErrors, TheTextNamesFieldValueAndRule)
{
    TRACES("R4");
    const InputError error("BodyDef.mass", "-1", "must be finite and > 0 kg");
    EXPECT_STREQ(error.what(), "BodyDef.mass = -1: must be finite and > 0 kg");
    EXPECT_EQ(error.field, "BodyDef.mass");
    EXPECT_EQ(error.value, "-1");
    EXPECT_EQ(error.rule, "must be finite and > 0 kg");
}

TEST(InputErrors, ACopyKeepsItsTextWhenTheOriginalIsGone)
{
    TRACES("R4");
    std::optional<InputError> first(std::in_place, "a field that is not short", "1", "must be 2");
    const InputError copy = *first;
    first.reset();
    EXPECT_STREQ(copy.what(), "a field that is not short = 1: must be 2");
}

TEST(InputErrors, FailThrowsWhatItWasGiven)
{
    TRACES("R4");
    try {
        fail(InputError("a", "b", "c"));
        FAIL() << "nothing was thrown";
    } catch (const std::exception& error) {
        EXPECT_STREQ(error.what(), "a = b: c");
    }
}

TEST(InputErrors, InstallingAHandlerReturnsTheOneBefore)
{
    TRACES("R4");
    const ErrorHandler mine = [](const InputError&) {};
    const ErrorHandler before = setErrorHandler(mine);
    EXPECT_EQ(setErrorHandler(before), mine);
}

TEST(ValueText, NumbersAreWrittenAsShortAsTheyReadBack)
{
    TRACES("R4");
    EXPECT_EQ(textOf(1.1), "1.1");
    EXPECT_EQ(textOf(1.1f), "1.1");  // not the 1.10000002384 it is in double
    EXPECT_EQ(textOf(-1), "-1");
    EXPECT_EQ(textOf(-0.5), "-0.5");
    EXPECT_EQ(textOf(1e300), "1e+300");
    EXPECT_EQ(textOf(std::uint64_t{18446744073709551615u}), "18446744073709551615");
    EXPECT_EQ(textOf(kNan), "nan");
    EXPECT_EQ(textOf(-kNan), "nan");
    EXPECT_EQ(textOf(kInfinity), "inf");
    EXPECT_EQ(textOf(-kInfinity), "-inf");
    EXPECT_EQ(textOf(""), "\"\"");
}

TEST(ValueText, PlacesAreWrittenAsPairs)
{
    TRACES("R4");
    EXPECT_EQ(textOf(Vec2{1, 2}), "(1, 2)");
    EXPECT_EQ(textOf(Position{kNan, 2}), "(nan, 2)");
    EXPECT_EQ(textOf(DVec2{0.1, -kInfinity}), "(0.1, -inf)");
}

TEST(Checks, ARangeHoldsItsEndsAndNeverNan)
{
    TRACES("R4");
    const auto inRange = [](double v) { return !checkRange("v", v, 0, 1, "must be in [0, 1]"); };
    EXPECT_TRUE(inRange(0));
    EXPECT_TRUE(inRange(1));
    EXPECT_FALSE(inRange(-1e-300));
    EXPECT_FALSE(inRange(1.1));
    EXPECT_FALSE(inRange(kNan));
    EXPECT_FALSE(inRange(kInfinity));
}

TEST(Checks, OnlyTheFirstComplaintIsRaised)
{
    TRACES("R4");
    Checks checks;
    checks.finite("fine", Vec2{1, 2}).that(false, "second", 3, "must be 2").finite("third", kNan);
    ASSERT_TRUE(checks.first());
    EXPECT_STREQ(checks.first()->what(), "second = 3: must be 2");
    EXPECT_THROW(checks.refuse(), InputError);
}

TEST(Checks, NothingWrongRaisesNothing)
{
    TRACES("R4");
    EXPECT_FALSE(Checks().finite("v", 1.0).range("r", 2, 1, 3, "must be in [1, 3]").refuse());
}

}  // namespace
}  // namespace tamias2d::test
