// SPDX-License-Identifier: MIT
// Calming: docs/theory/calm.md. The sign test keeps it honest: whatever starts to slide or topple
// gains kinetic energy, and is left alone.

#include "solver/calm.hpp"

#include "solver/body_mass.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Which islands bear a load somewhere: there is nothing to calm in others, as those of shapes that fall side
// by side. Is there one?
bool findLoaded(const Table<Motion>& rows, CalmRows& calmRows)
{
    bool any = false;
    calmRows.islands.assign(calmRows.islands.size(), {});
    for (const auto [row, number] : calmRows.chosenFloating)
        if (rows[row].isLoaded()) any = calmRows.islands[number].bears = true;
    return any;
}

// Mass-weighted rigid motion of each island without a ground that bears a load.
void measureFreeIslands(const Table<Motion>& rows, const Table<TickChange>& changes, CalmRows& calmRows)
{
    std::vector<FreeIsland>& free = calmRows.islands;
    const auto each = [&](auto&& visit) {
        for (const FloatingRow& is : calmRows.chosenFloating)
            if (free[is.island].bears && rows[is.row].isFree())
                visit(free[is.island], rows[is.row], changes[is.row]);
    };
    each([](FreeIsland& island, const Motion& m, const TickChange& change) {
        if (!island.started) island.first = m.center;
        island.started = true;
        const double mass = massOf(m);
        island.mass += mass;
        island.weighted += mass * (m.center - island.first);
        island.momentum += mass * toDVec2(m.velocity);
        island.momentumChange += mass * toDVec2(change.velocity);
    });
    for (FreeIsland& island : free) {
        if (!(island.mass > 0)) continue;
        const double inverse = 1 / island.mass;
        island.motion.center = island.first + inverse * island.weighted;
        island.motion.velocity = toVec2(inverse * island.momentum);
        island.motion.change = toVec2(inverse * island.momentumChange);
    }
    each([](FreeIsland& island, const Motion& m, const TickChange& change) {
        const Vec2 r = toVec2(m.center - island.motion.center);
        const double mass = massOf(m), inertia = inertiaOf(m);
        island.inertia += mass * static_cast<double>(dot(r, r)) + inertia;
        island.turning += mass * static_cast<double>(cross(r, m.velocity - island.motion.velocity)) +
                          inertia * static_cast<double>(m.spin);
        island.turningChange += mass * static_cast<double>(cross(r, change.velocity - island.motion.change)) +
                                inertia * static_cast<double>(change.spin);
    });
    for (FreeIsland& island : free) {
        if (!(island.inertia > 0)) continue;
        island.motion.spin = static_cast<real>(island.turning / island.inertia);
        island.motion.spinChange = static_cast<real>(island.turningChange / island.inertia);
    }
}

void calmFloating(Table<Motion>& rows, const Table<TickChange>& changes, CalmRows& calmRows,
                  const StepContext& context)
{
    if (!findLoaded(rows, calmRows)) return;
    std::vector<FreeIsland>& free = calmRows.islands;
    measureFreeIslands(rows, changes, calmRows);

    for (const auto [i, number] : calmRows.chosenFloating) {
        Motion& m = rows[i];
        if (!m.isLoaded() || !m.isFree()) continue;  // a locked one's momentum could not be given back
        FreeIsland& island = free[number];
        const CalmReference& reference = island.motion;

        // Motion against the island's, and whether its kinetic energy rises.
        const Vec2 r = toVec2(m.center - reference.center);
        const Vec2 u = m.velocity - reference.velocity - cross(reference.spin, r);
        const real w = m.spin - reference.spin;
        const Vec2 du = changes[i].velocity - reference.change - cross(reference.spinChange, r);
        const real dw = changes[i].spin - reference.spinChange;
        const double mass = massOf(m), inertia = inertiaOf(m);
        const double power = mass * static_cast<double>(dot(u, du)) + inertia * static_cast<double>(w * dw);
        const real speed = (length(u) + absolute(w) * m.extent) / context.calmSpeed();
        if (power > 0 || speed >= 1) continue;

        const real part = context.tuning.calmRate * (1 - speed * speed);
        m.velocity -= part * u;
        if (m.invInertia > 0) m.spin -= part * w;
        island.lost += mass * static_cast<double>(part) * toDVec2(u);
        island.lostSpin += static_cast<double>(part) *
                           (mass * static_cast<double>(cross(r, u)) + inertia * static_cast<double>(w));
    }

    // What an island lost comes back as a rigid motion of the whole.
    for (const auto [i, number] : calmRows.chosenFloating) {
        Motion& m = rows[i];
        const FreeIsland& f = free[number];
        if (!m.isFree() || !(f.mass > 0) || !(f.inertia > 0)) continue;
        const Vec2 r = toVec2(m.center - f.motion.center);
        const real turn = static_cast<real>(f.lostSpin / f.inertia);
        m.velocity += toVec2((1 / f.mass) * f.lost) + cross(turn, r);
        if (m.invInertia > 0) m.spin += turn;
    }
}

}  // namespace

void findCalmRows(const Islands& islands, CalmRows& found)
{
    found.grounded.clear();
    found.floating.clear();
    found.numberOf.assign(islands.count(), Islands::kNone);
    std::uint32_t floating = 0;
    for (std::uint32_t i = 0; i < islands.islandOf.size(); ++i) {
        const std::uint32_t island = islands.islandOf[i];
        if (island == Islands::kNone || islands.sizeOf[island] < 2) continue;  // a lone body is calm
        const std::uint32_t ground = islands.groundOf[island];
        if (ground == Islands::kSeveral) continue;  // no one motion to come to rest against
        if (ground != Islands::kNone) {
            found.grounded.push_back({i, ground});
            continue;
        }
        if (found.numberOf[island] == Islands::kNone) found.numberOf[island] = floating++;
        found.floating.push_back({i, found.numberOf[island]});
    }
    found.islands.resize(floating);
}

void chooseCalmRows(const std::vector<std::uint8_t>& quiet, bool isQuiet, CalmRows& calmRows)
{
    const auto choose = [&](const auto& from, auto& into) {
        into.clear();
        into.reserve(from.capacity());
        for (const auto& each : from)
            if ((each.row < quiet.size() && quiet[each.row] != 0) == isQuiet) into.push_back(each);
    };
    choose(calmRows.grounded, calmRows.chosenGrounded);
    choose(calmRows.floating, calmRows.chosenFloating);
}

void calm(Table<Motion>& rows, TickRows& lanes, CalmRows& calmRows, const BodyKernels& kernels,
          const StepContext& context, Parallel& parallel)
{
    if (!(context.tuning.calmRate > 0)) return;
    const std::vector<CalmPair>& grounded = calmRows.chosenGrounded;
    parallel.forEach(grounded.size(), kBodyGrain, [&](const Chunk& chunk) {
        kernels.calm(rows.data(), grounded.data() + chunk.begin, chunk.end - chunk.begin, lanes, context);
    });
    calmFloating(rows, lanes.changes, calmRows, context);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
