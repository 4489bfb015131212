// SPDX-License-Identifier: MIT
// The way of contacts from the rows of the table into their lanes, and back.
#pragma once

#include "contacts/rows.hpp"
#include "solver/contact_lanes_of.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
void ContactLanesOf<W>::load(std::uint32_t contact, const Contact& c, const MotionTable& motions,
                             const TickRows& rows)
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    const std::uint32_t bit = 1u << lane;
    Block& b = blocks_[slot / W];
    Source& s = sources_[slot / W];
    const auto set = [bit](std::uint32_t& bits, bool on) { bits = on ? bits | bit : bits & ~bit; };
    set(b.active, true);
    set(b.two, c.count == 2);
    set(s.elastic, c.restitution > 0);
    set(s.atImpact, c.atImpact);
    set(s.touching, c.touching);

    const Motion &mA = motions.rows[c.rowA], &mB = motions.rows[c.rowB];
    setLane(b.row.normal, lane, c.normal);
    setLane(b.row.invMassA, lane, mA.invMass);
    setLane(b.row.invMassB, lane, mB.invMass);
    b.row.invInertiaA.v[lane] = mA.invInertia;
    b.row.invInertiaB.v[lane] = mB.invInertia;
    b.row.friction.v[lane] = c.friction;
    b.row.surfaceSpeed.v[lane] = c.surfaceSpeed;
    b.row.blockInverse.v[lane] = 0;
    s.slowest.v[lane] = leastApproach(c, context_);
    setLane(s.start, lane, startBetween(rows, c.rowA, c.rowB));
    s.restGap.v[lane] = c.restGap;
    s.radiusA.v[lane] = c.radiusA;
    s.radiusB.v[lane] = c.radiusB;
    s.turns.v[lane] = c.count == 1 && normalTurns(c, c.points[0].anchor) ? -1 : 0;
    s.counted.v[lane] = 0;
    setLane(s.stepImpulse, lane, c.stepImpulse);
    for (int k = 0; k < 2; ++k) {
        const ContactPointRow& p = c.points[k];
        const bool present = k < c.count;
        s.present[k].v[lane] = present ? -1 : 0;
        s.cornerOnA[k].v[lane] = p.anchor.cornerOnA ? -1 : 0;
        setLane(s.localA[k], lane, present ? p.anchor.localA : Vec2{});
        setLane(s.localB[k], lane, present ? p.anchor.localB : Vec2{});
        b.row.points[k].normalImpulse.v[lane] = present ? p.normalImpulse : real(0);
        b.row.points[k].tangentImpulse.v[lane] = present ? p.tangentImpulse : real(0);
        s.stepNormal[k].v[lane] = p.stepNormal;
        s.stepTangent[k].v[lane] = p.stepTangent;
    }
}

// Block by block: two threads must not write lanes of one block.
template <int W>
void ContactLanesOf<W>::loadMarked(const std::vector<std::uint8_t>& marks, std::uint8_t mark,
                                   const Table<Contact>& contacts, const MotionTable& motions,
                                   const TickRows& rows)
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t slot = chunk.begin * W; slot < chunk.end * W; ++slot) {
            const std::uint32_t contact = slots_[slot];
            if (contact != kNone && marks[contact] == mark) load(contact, contacts[contact], motions, rows);
        }
    });
}

template <int W>
LaneView ContactLanesOf<W>::view(std::uint32_t contact) const
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    const Block& b = blocks_[slot / W];
    const Source& s = sources_[slot / W];
    LaneView view;
    view.normal = laneOf(b.row.normal, lane);
    for (int k = 0; k < 2; ++k) {
        const PointRow<Lane<W>>& p = b.row.points[k];
        view.points[k] = {p.turnA.v[lane],
                          p.turnB.v[lane],
                          s.gap[k].v[lane],
                          p.normalInverse.v[lane] > 0,
                          (b.unloaded[k] >> lane & 1u) == 0,
                          p.normalImpulse.v[lane],
                          p.tangentImpulse.v[lane]};
        view.isLoaded = view.isLoaded || p.normalImpulse.v[lane] > 0;
    }
    return view;
}

template <int W>
void ContactLanesOf<W>::store(std::size_t slot, Contact& c) const
{
    const auto lane = static_cast<int>(slot % W);
    const Block& b = blocks_[slot / W];
    const Source& s = sources_[slot / W];
    c.normal = laneOf(b.row.normal, lane);
    c.stepImpulse = laneOf(s.stepImpulse, lane);
    for (int k = 0; k < c.count; ++k) {
        ContactPointRow& p = c.points[k];
        p.normalImpulse = b.row.points[k].normalImpulse.v[lane];
        p.tangentImpulse = b.row.points[k].tangentImpulse.v[lane];
        p.stepNormal = s.stepNormal[k].v[lane];
        p.stepTangent = s.stepTangent[k].v[lane];
    }
    if (solved_ && s.counted.v[lane] != 0) addToSums(c, 1);
}

// It moves nothing any more.
template <int W>
void ContactLanesOf<W>::drop(std::uint32_t contact)
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    Block& b = blocks_[slot / W];
    b.active &= ~(1u << lane);
    for (int k = 0; k < 2; ++k) {
        b.row.points[k].normalInverse.v[lane] = b.row.points[k].tangentInverse.v[lane] = 0;
        b.row.points[k].normalImpulse.v[lane] = b.row.points[k].tangentImpulse.v[lane] = 0;
        sources_[slot / W].present[k].v[lane] = 0;
    }
    b.row.blockInverse.v[lane] = 0;
}

template <int W>
void ContactLanesOf<W>::unload(std::uint32_t contact, Contact& c)
{
    const std::uint32_t slot = laneOf_[contact];
    store(slot, c);
    for (int k = 0; k < c.count; ++k)
        c.points[k].wasLoaded = (blocks_[slot / W].unloaded[k] >> slot % W & 1u) == 0;
    drop(contact);
}

// With the places of its points, which only the end of a step needs.
template <int W>
void ContactLanesOf<W>::tellOf(std::size_t slot, Contact& c) const
{
    store(slot, c);
    const auto lane = static_cast<int>(slot % W);
    const Block& b = blocks_[slot / W];
    for (int k = 0; k < c.count; ++k) {
        const PointRow<Lane<W>>& p = b.row.points[k];
        c.points[k].gap = sources_[slot / W].gap[k].v[lane];
        c.points[k].armA = armOf(c.normal, p.turnA.v[lane], p.slideA.v[lane]);
        c.points[k].armB = armOf(c.normal, p.turnB.v[lane], p.slideB.v[lane]);
    }
}

template <int W>
void ContactLanesOf<W>::tellAll(Table<Contact>& rows) const
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k)
            for (std::size_t lane = 0; lane < W; ++lane)
                if ((blocks_[k].active >> lane & 1u) != 0) tellOf(k * W + lane, rows[slots_[k * W + lane]]);
    });
}

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
