// SPDX-License-Identifier: MIT
// Who makes a step in one tick, and who must not any more. docs/theory/calm.md, section 6.

#include "solver/quiet_bodies.hpp"

#include "base/disjoint_sets.hpp"
#include "solver/integrate.hpp"
#include "solver/tick_sweeps.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Of a row: what it is, and whether anything is near.
enum State : std::uint8_t { Slow = 0, Moves = 1, StillGround = 2, Near = 4 };

State stateOf(const ImpactStage& stage, std::uint32_t row, bool varies)
{
    const Motion& m = stage.motions.rows[row];
    if (!m.moves()) return m.velocity == Vec2{} && m.spin == 0 ? StillGround : Moves;
    if (stage.motions.slow[row] == 0 || stage.visited.isLone(row) || stage.system.isTied(row)) return Moves;
    return varies && stage.field.variesFor(m, stage.world.bodies) ? Moves : Slow;
}

// Returns whether any body that may move is slow.
bool findStates(const ImpactStage& stage, bool varies, std::vector<std::uint8_t>& states)
{
    states.reserve(stage.motions.rows.capacity());
    states.resize(stage.motions.rows.size());
    bool any = false;
    for (std::uint32_t row = 0; row < states.size(); ++row) {
        states[row] = stateOf(stage, row, varies);
        any = any || states[row] == Slow;
    }
    return any;
}

void findCompanies(const ImpactStage& stage, std::vector<std::uint32_t>& parent)
{
    const Table<Motion>& rows = stage.motions.rows;
    parent.reserve(rows.capacity());
    DisjointSets sets(parent);
    sets.reset(rows.size());
    for (const PairRow& pair : stage.scratch.pairs)
        if (rows[pair.rowA].moves() && rows[pair.rowB].moves()) sets.join(pair.rowA, pair.rowB);
}

// Companies in which anybody moves, or that meet a ground that does, may meet anything in mid-step, or are
// solved at once.
void findRestless(const ImpactStage& stage, QuietScratch& scratch)
{
    std::vector<std::uint8_t>& states = scratch.states;
    const Table<PairRow>& pairs = stage.scratch.pairs;
    DisjointSets companies(scratch.parent);
    scratch.restless.reserve(states.capacity());
    scratch.restless.assign(states.size(), 0);
    const auto disturb = [&](const PairRow& pair) {
        scratch.restless[companies.leader(pair.rowA)] = scratch.restless[companies.leader(pair.rowB)] = 1;
    };
    for (const PairRow& pair : pairs) {
        if (((states[pair.rowA] | states[pair.rowB]) & Moves) != 0) disturb(pair);
        states[pair.rowA] |= Near;
        states[pair.rowB] |= Near;
    }
    for (const std::uint32_t i : stage.scratch.swept) disturb(pairs[i]);
    const StiffPiles& piles = stage.passes.piles();
    for (std::size_t p = 0; p < piles.count(); ++p)
        for (const std::uint32_t i : piles[p].contacts) disturb(pairs[i]);
}

}  // namespace

bool findQuiet(ImpactStage& stage, const StepContext& context, bool same, bool varies, QuietScratch& scratch)
{
    scratch.parentIsStale = scratch.parentIsStale || !same;
    if (!(context.tuning.quiet > 0) || !findStates(stage, varies, scratch.states)) return false;
    if (scratch.parentIsStale) findCompanies(stage, scratch.parent);
    scratch.parentIsStale = false;
    findRestless(stage, scratch);
    DisjointSets companies(scratch.parent);
    bool any = false;
    scratch.quiet.reserve(scratch.states.capacity());
    scratch.quiet.resize(scratch.states.size());
    for (std::uint32_t row = 0; row < scratch.states.size(); ++row) {
        std::uint8_t& state = scratch.states[row];
        // One that nothing is near is alone: whether a tick visits it or not must not change it.
        const bool isGround = (state & StillGround) != 0;
        if (!isGround && (state == Slow || scratch.restless[companies.leader(row)] != 0)) state |= Moves;
        any = any || (state & ~Near) == Slow;
        scratch.quiet[row] = (state & Moves) == 0 ? 1 : 0;
    }
    return any;
}

std::uint32_t countQuiet(const VisitedBodies& visited, const QuietScratch& scratch)
{
    std::uint32_t count = 0;
    if (!visited.anyQuiet()) return count;
    for (std::uint32_t row = 0; row < scratch.states.size(); ++row)
        if ((scratch.states[row] & ~Near) == Slow && visited.isQuiet(row)) ++count;
    return count;
}

void wakeQuiet(ImpactStage& stage, std::uint32_t row, const StepContext& context)
{
    Table<Motion>& rows = stage.motions.rows;
    if (!stage.visited.isQuiet(row) || !rows[row].moves()) return;
    ImpactScratch& scratch = stage.scratch;
    std::vector<std::uint32_t>&bodies = scratch.woken, &contacts = scratch.wokenContacts;
    bodies.clear();
    contacts.clear();
    const auto take = [&](std::uint32_t body) {
        if (!stage.visited.isQuiet(body) || !rows[body].moves()) return;
        stage.visited.wake(body);
        startDamping(rows[body], context.h);
        stage.rows.steady[body] = {};
        bodies.push_back(body);
    };
    take(row);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const ContactChains& chains = scratch.chains;
        for (std::uint32_t link = chains.first(bodies[k]); link != ContactChains::kEnd;
             link = chains.next(link)) {
            const std::uint32_t i = ContactChains::contactOf(link);
            if (stage.passes.comeIn(i, stage.contacts, context.ticks - scratch.tick)) contacts.push_back(i);
            take(scratch.pairs[i].rowA);
            take(scratch.pairs[i].rowB);
        }
    }

    // The tick begins for them as it has begun for all others.
    std::sort(contacts.begin(), contacts.end(), [&](std::uint32_t a, std::uint32_t b) {
        return stage.passes.placeOf(a) < stage.passes.placeOf(b);
    });
    for (const std::uint32_t i : contacts) startLoose(stage.contacts.rows[i], stage.motions, stage.rows);
    for (const std::uint32_t body : bodies) {
        std::uint32_t none[1];  // it does not stray
        StrayList strays{none, 0};
        stage.kernels.startTick({rows.data(), stage.rows, body, body + 1}, context,
                                timeOf(scratch.tick, context), strays);
        predictWay(stage, body, context);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
