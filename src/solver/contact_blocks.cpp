// SPDX-License-Identifier: MIT
// Passes over contacts, several at once: the formulas of contacts/row_kernel.hpp on lanes.

#include "solver/contact_blocks.hpp"

#include "contacts/rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// One body each of several contacts; the names are those of Motion.
struct WideBody {
    WideVec2 velocity;
    Wide spin;
    WideVec2 invMass;
    Wide invInertia;
};

LaneRow laneRowOf(const Motion& m)
{
    return {m.velocity.x, m.velocity.y, m.spin, 0};
}

void setVelocity(Motion& m, const LaneRow& row)
{
    m.velocity = {row.x, row.y};
    m.spin = row.z;
}

bool isPlain(const Contact& c)
{
    if (c.impacts > 0 || c.rolling > 0 || c.rollingImpulse != 0) return false;
    for (int i = 0; i < c.count; ++i) {
        const ContactPointRow& p = c.points[i];
        if (!(p.normalMass > 0) || !(p.tangentMass > 0)) return false;
        if (c.restitution > 0 && !p.wasLoaded) return false;
    }
    return true;
}

void setLane(WidePoint& wide, int lane, const ContactPointRow& point, const StepContext& context)
{
    wide.armA.x.v[lane] = point.armA.x;
    wide.armA.y.v[lane] = point.armA.y;
    wide.armB.x.v[lane] = point.armB.x;
    wide.armB.y.v[lane] = point.armB.y;
    wide.allowed.v[lane] = allowedApproach(point, context);
    wide.normalMass.v[lane] = point.normalMass;
    wide.tangentMass.v[lane] = point.tangentMass;
    wide.normalImpulse.v[lane] = point.normalImpulse;
    wide.tangentImpulse.v[lane] = point.tangentImpulse;
}

void setLane(ContactBlock& block, int lane, std::uint32_t i, const Contact& c, const Motion& a,
             const Motion& b, std::uint32_t island, const StepContext& context)
{
    block.contact[lane] = i;
    block.rowA[lane] = c.rowA;
    block.rowB[lane] = c.rowB;
    block.island[lane] = island;
    block.normal.x.v[lane] = c.normal.x;
    block.normal.y.v[lane] = c.normal.y;
    block.friction.v[lane] = c.friction;
    block.surfaceSpeed.v[lane] = c.surfaceSpeed;
    block.crossMass.v[lane] = c.crossMass;
    block.invMassA.x.v[lane] = a.invMass.x;
    block.invMassA.y.v[lane] = a.invMass.y;
    block.invMassB.x.v[lane] = b.invMass.x;
    block.invMassB.y.v[lane] = b.invMass.y;
    block.invInertiaA.v[lane] = a.invInertia;
    block.invInertiaB.v[lane] = b.invInertia;
    for (int k = 0; k < c.count; ++k) setLane(block.points[k], lane, c.points[k], context);
}

}  // namespace

void gatherBlocks(const ContactTable& contacts, const MotionTable& motions, const Islands& islands,
                  const StepContext& context, ContactBlocks& blocks)
{
    constexpr std::size_t kNoBlock = ~std::size_t{0};
    blocks.colors.clear();
    blocks.blocks.clear();
    blocks.singles.clear();
    blocks.velocities.resize(motions.rows.size());
    for (std::size_t row = 0; row < motions.rows.size(); ++row)
        blocks.velocities[row] = laneRowOf(motions.rows[row]);

    // Contacts found in mid-step stand behind all colors, and like those of the last color are no neighbors'
    // friends: they are visited in order.
    std::size_t place = 0;
    for (std::size_t color = 0; color <= contacts.colorEnds.size(); ++color) {
        const bool ordered = color + 1 >= contacts.colorEnds.size();
        const std::size_t end =
            color < contacts.colorEnds.size() ? contacts.colorEnds[color] : contacts.order.size();
        std::size_t open[2] = {kNoBlock, kNoBlock};  // by points, less one
        for (; place < end; ++place) {
            const std::uint32_t i = contacts.order[place];
            const Contact& c = contacts.rows[i];
            if (c.count == 0) continue;
            if (ordered || !isPlain(c)) {
                blocks.singles.push_back(i);
                continue;
            }
            std::size_t& at = open[c.count - 1];
            if (at == kNoBlock) {
                at = blocks.blocks.size();
                blocks.blocks.emplace_back();
                blocks.blocks.back().count = c.count;
            }
            ContactBlock& block = blocks.blocks[at];
            const Motion &a = motions.rows[c.rowA], &b = motions.rows[c.rowB];
            const std::uint32_t island = islandOf(islands, c.rowA, c.rowB);
            const int first = block.lanes;
            // The first lane fills all, so that the last block of a color reckons with numbers.
            for (int lane = first; lane < (first == 0 ? kLanes : first + 1); ++lane)
                setLane(block, lane, i, c, a, b, island, context);
            block.movesA[first] = a.moves();
            block.movesB[first] = b.moves();
            if (++block.lanes == kLanes) at = kNoBlock;
        }
        blocks.colors.push_back({static_cast<std::uint32_t>(blocks.blocks.size()),
                                 static_cast<std::uint32_t>(blocks.singles.size())});
    }
}

namespace {

WideBody gatherBody(const std::vector<LaneRow>& velocities, const std::uint32_t (&rows)[kLanes],
                    WideVec2 invMass, Wide invInertia)
{
    WideBody body{{}, {}, invMass, invInertia};
    const LaneRow* from[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) from[lane] = &velocities[rows[lane]];
    gatherRows(from, body.velocity.x, body.velocity.y, body.spin);
    return body;
}

void scatterBody(const WideBody& body, const std::uint32_t (&rows)[kLanes], const bool (&written)[kLanes],
                 std::vector<LaneRow>& velocities)
{
    LaneRow* to[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) to[lane] = written[lane] ? &velocities[rows[lane]] : nullptr;
    scatterRows(body.velocity.x, body.velocity.y, body.spin, to);
}

template <class T>
void keepWhere(LaneMask<kLanes> mask, T& value, const T& other)
{
    value = select(mask, value, other);
}
void keepWhere(LaneMask<kLanes> mask, WideBody& body, const WideBody& other)
{
    keepWhere(mask, body.velocity.x, other.velocity.x);
    keepWhere(mask, body.velocity.y, other.velocity.y);
    keepWhere(mask, body.spin, other.spin);
}

// Two normals: as a block, and one after the other in the lanes where that cannot be.
Wide solveNormals(ContactBlock& block, WideBody& a, WideBody& b)
{
    WidePoint &p = block.points[0], &q = block.points[1];
    if (block.count == 1) return solveNormal(block, p, a, b, p.allowed);
    LaneMask<kLanes> solved;
    Wide change = solveNormalsAsBlock(block, a, b, p.allowed, q.allowed, solved);
    if (!any(!solved)) return change;

    WideBody singlyA = a, singlyB = b;
    WidePoint singlyP = p, singlyQ = q;
    const Wide one = solveNormal(block, singlyP, singlyA, singlyB, p.allowed);
    const Wide other = solveNormal(block, singlyQ, singlyA, singlyB, q.allowed);
    keepWhere(solved, a, singlyA);
    keepWhere(solved, b, singlyB);
    keepWhere(solved, p.normalImpulse, singlyP.normalImpulse);
    keepWhere(solved, q.normalImpulse, singlyQ.normalImpulse);
    keepWhere(solved, change, maximum(maximum(Wide(real(0)), one), other));
    return change;
}

// The greatest change of normal speed in each lane.
Wide solve(ContactBlock& block, std::vector<LaneRow>& velocities, const bool (&writtenA)[kLanes],
           const bool (&writtenB)[kLanes])
{
    WideBody a = gatherBody(velocities, block.rowA, block.invMassA, block.invInertiaA);
    WideBody b = gatherBody(velocities, block.rowB, block.invMassB, block.invInertiaB);
    const Wide change = solveNormals(block, a, b);
    for (int k = 0; k < block.count; ++k) solveFriction(block, block.points[k], a, b);
    scatterBody(a, block.rowA, writtenA, velocities);
    scatterBody(b, block.rowB, writtenB, velocities);
    return change;
}

// The same in some lanes only.
Wide solveSome(ContactBlock& block, std::vector<LaneRow>& velocities, const bool* visited)
{
    bool writtenA[kLanes], writtenB[kLanes];
    LaneMask<kLanes> mask{};
    for (int lane = 0; lane < kLanes; ++lane) {
        writtenA[lane] = visited[lane] && block.movesA[lane];
        writtenB[lane] = visited[lane] && block.movesB[lane];
        mask.v[lane] = visited[lane] ? -1 : 0;
    }
    const WidePoint old[2] = {block.points[0], block.points[1]};
    const Wide change = solve(block, velocities, writtenA, writtenB);
    for (int k = 0; k < block.count; ++k) {
        keepWhere(mask, block.points[k].normalImpulse, old[k].normalImpulse);
        keepWhere(mask, block.points[k].tangentImpulse, old[k].tangentImpulse);
    }
    return change;
}

}  // namespace

void passOver(ContactBlocks& blocks, ContactTable& contacts, MotionTable& motions, const Islands& islands,
              const StepContext& context, real restless, const std::vector<real>& before,
              std::vector<real>& unrest)
{
    const auto isVisited = [&](std::uint32_t island) { return before.empty() || before[island] > restless; };
    std::uint32_t nextBlock = 0, nextSingle = 0;
    for (const ContactBlocks::Color& color : blocks.colors) {
        for (; nextBlock < color.blocksEnd; ++nextBlock) {
            ContactBlock& block = blocks.blocks[nextBlock];
            bool visited[kLanes] = {}, all = true, some = false;
            for (int lane = 0; lane < block.lanes; ++lane) {
                visited[lane] = isVisited(block.island[lane]);
                all = all && visited[lane];
                some = some || visited[lane];
            }
            if (!some) continue;
            const Wide change = all ? solve(block, blocks.velocities, block.movesA, block.movesB)
                                    : solveSome(block, blocks.velocities, visited);
            for (int lane = 0; lane < block.lanes; ++lane) {
                real& most = unrest[block.island[lane]];
                if (visited[lane]) most = maximum(most, change.v[lane]);
            }
        }
        for (; nextSingle < color.singlesEnd; ++nextSingle) {
            Contact& c = contacts.rows[blocks.singles[nextSingle]];
            const std::uint32_t island = islandOf(islands, c.rowA, c.rowB);
            if (!isVisited(island)) continue;
            Motion &a = motions.rows[c.rowA], &b = motions.rows[c.rowB];
            LaneRow &rowA = blocks.velocities[c.rowA], &rowB = blocks.velocities[c.rowB];
            setVelocity(a, rowA);
            setVelocity(b, rowB);
            unrest[island] = maximum(unrest[island], solveContact(c, a, b, context));
            rowA = laneRowOf(a);
            rowB = laneRowOf(b);
        }
    }
}

namespace {

void addUp(Contact& c)
{
    for (int k = 0; k < c.count; ++k) {
        ContactPointRow& point = c.points[k];
        point.stepNormal += point.normalImpulse;
        point.stepTangent += point.tangentImpulse;
        c.stepImpulse += point.normalImpulse * c.normal + point.tangentImpulse * perpendicular(c.normal);
    }
}

}  // namespace

void scatterBlocks(const ContactBlocks& blocks, ContactTable& contacts, MotionTable& motions)
{
    for (const ContactBlock& block : blocks.blocks) {
        for (int lane = 0; lane < block.lanes; ++lane) {
            Contact& c = contacts.rows[block.contact[lane]];
            for (int k = 0; k < c.count; ++k) {
                c.points[k].normalImpulse = block.points[k].normalImpulse.v[lane];
                c.points[k].tangentImpulse = block.points[k].tangentImpulse.v[lane];
            }
            addUp(c);
        }
    }
    for (const std::uint32_t i : blocks.singles) addUp(contacts.rows[i]);
    for (std::size_t row = 0; row < motions.rows.size(); ++row)
        setVelocity(motions.rows[row], blocks.velocities[row]);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
