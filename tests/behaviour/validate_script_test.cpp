// SPDX-License-Identifier: MIT
// Whatever is done to a world, in whatever order: its tables hold all their invariants after each operation.
#include "support/script.hpp"
#include "support/traces.hpp"

namespace tamias2d {
namespace {

using namespace test;

class ValidatedScript final : public RandomScript {
public:
    using RandomScript::RandomScript;

private:
    void afterEach() override
    {
        for (const std::string& fault : world_.validate()) ADD_FAILURE() << fault;
    }
};

TEST(Validate, FindsNothingInTenThousandRandomOperations)
{
    TRACES("R1", "R4", "ADR4", "ADR12");
    for (const std::uint32_t seed : {1u, 2u, 4u, 5u, 15u, 31u}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        ValidatedScript script(seed);
        script.run(10000);
        EXPECT_GT(script.steps(), 2000);
    }
}

TEST(Validate, FindsNothingInAWorldOfSmallAndOneOfLargeUnits)
{
    TRACES("R4", "ADR15");
    for (const double unit : {0.01, 50.0}) {
        SCOPED_TRACE("lengthUnit " + std::to_string(unit));
        WorldDef def;
        def.lengthUnit = toReal(unit);
        ValidatedScript script(4, def);
        script.run(2000);
    }
}

}  // namespace
}  // namespace tamias2d
