// SPDX-License-Identifier: MIT
// No place and no scale is special: a million metres out and in millimetres or kilometres, the same happens.
#include <support/run.hpp>
#include <support/scenes.hpp>

namespace tamias2d::test {
namespace {

constexpr double kFarApart = 1e-3;    // [m]
constexpr double kScaledApart = 1e-4; // of lengthUnit

// Ten stacked boxes on a floor around `x`.
std::vector<Placed> stackAt(World& world, double x)
{
    addBox(world, {x, -0.5}, 100, 1, {.type = BodyType::Static});
    return addStack(world, 10, x);
}

TEST(Far, AStackAMillionMetresOutStandsAsAtTheOrigin)
{
    TRACES("R1", "R5", "ADR3");
    const double far = 1e6;
    World here, there;
    const std::vector<Placed> near = stackAt(here, 0), distant = stackAt(there, far);
    double apart = 0;
    for (int i = 0; i < 600; ++i) {
        here.step();
        there.step();
        for (std::size_t k = 0; k < near.size(); ++k) {
            const DVec2 p = near[k].body.position() - Position{},
                        q = distant[k].body.position() - Position{far, 0};
            apart = std::max(apart, length(p - q));
        }
    }
    EXPECT_LE(apart, kFarApart);
    record("apart_m", apart);
}

// A scene `k` times as large: lengths, gravity, speeds and lengthUnit times k, times as they are. Masses are
// kept by density / k^2. It has a stack, a ball that bounces, a box that slides to rest, a disc that rolls up
// a slope and back, flat landings and a weightless spinner.
class ScaledScene {
public:
    explicit ScaledScene(double k) : k_(k), world_(definition(k))
    {
        floor({0, -0.5}, 100, 1, 0);
        floor({30, 1}, 20, 1, 0.2);
        for (int i = 0; i < 10; ++i)
            add(makeBox(length(1), length(1)), {0, 0.5 + 0.001 + i * 1.001}, {}, 0, 0);
        add(Circle{{}, length(0.4)}, {-5, 4}, {0.3, 0}, 0, 0.8);
        add(makeBox(length(1), length(0.5)), {-20, 0.2505}, {3, 0}, 0, 0);
        add(Circle{{}, length(0.5)}, {20, 0.501}, {1.6, 0}, -3.2, 0);
        add(makeBox(length(1), length(1)), {-10, 2.5}, {}, 0, 0);
        const Capsule capsule{scaled({-0.4, 0}), scaled({0.4, 0}), length(0.2)};
        add(capsule, {-30, 1}, {1, 4}, 0, 0);
        // Landing on an end is chaos: it makes errors 10^4 times as large, more than float has digits for.
        if (kDouble) add(capsule, {-35, 1}, {1, 4}, 2, 0);
        add(makeBox(length(0.6), length(0.4)), {-5, 12}, {-1, 0.5}, 3, 0);
        bodies_.back().setGravityScale(0);
    }

    void step() { world_.step(); }
    std::size_t size() const { return bodies_.size(); }

    // In lengths of the unit scene: how far the center, or a point half a metre from it by its turning, is
    // away.
    double apart(const ScaledScene& other, std::size_t i) const
    {
        const Position p = bodies_[i].position(), q = other.bodies_[i].position();
        const DVec2 d{p.x / k_ - q.x / other.k_, p.y / k_ - q.y / other.k_};
        return std::max(tamias2d::length(d),
                        0.5 * std::abs(angleDifference(bodies_[i].angle(), other.bodies_[i].angle())));
    }

private:
    static WorldDef definition(double k)
    {
        WorldDef def;
        def.gravity = vec(0, -9.81 * k);
        def.lengthUnit = toReal(k);
        return def;
    }
    real length(double l) const { return toReal(l * k_); }
    Vec2 scaled(DVec2 v) const { return vec(v.x * k_, v.y * k_); }

    void floor(DVec2 at, double width, double height, double angle)
    {
        addBox(world_, {at.x * k_, at.y * k_}, width * k_, height * k_,
               {.type = BodyType::Static, .angle = angle});
    }
    void add(const Geometry& geometry, DVec2 at, DVec2 velocity, double spin, double restitution)
    {
        bodies_.push_back(addBody(world_, {at.x * k_, at.y * k_}, geometry,
                                  {.velocity = scaled(velocity),
                                   .spin = spin,
                                   .density = 1 / (k_ * k_),
                                   .restitution = restitution}));
    }

    double k_;
    World world_;
    std::vector<Body> bodies_;
};

// Runs both for 5 s; the furthest each body ever is from its twin.
std::vector<double> apartInFiveSeconds(double k)
{
    ScaledScene unit(1), scaled(k);
    std::vector<double> apart(unit.size(), 0);
    for (int i = 0; i < 300; ++i) {
        unit.step();
        scaled.step();
        for (std::size_t b = 0; b < apart.size(); ++b) apart[b] = std::max(apart[b], scaled.apart(unit, b));
    }
    return apart;
}

TEST(Scale, FromMillimetresToKilometresTheTrajectoriesAreTheSame)
{
    TRACES("R1", "R5", "R6", "R8", "ADR15");
    for (const double k : {0.001, 0.01, 0.1, 10.0, 100.0, 1000.0}) {
        const std::vector<double> apart = apartInFiveSeconds(k);
        for (std::size_t b = 0; b < apart.size(); ++b)
            EXPECT_LE(apart[b], kScaledApart) << "scale " << k << ", body " << b;
        char what[32];
        std::snprintf(what, sizeof what, "apart_at_%g", k);
        record(what, *std::max_element(apart.begin(), apart.end()));
    }
}

// Powers of two change no digit of any number, so nothing may differ unless a length is hidden in the code.
TEST(Scale, ByPowersOfTwoNotOneBitOfATrajectoryChanges)
{
    TRACES("R1", "R5", "R6", "R8", "ADR15");
    for (const double k : {1.0 / 1024, 0.5, 1024.0})
        for (const double apart : apartInFiveSeconds(k)) EXPECT_EQ(apart, 0) << "scale " << k;
}

}  // namespace
}  // namespace tamias2d::test
