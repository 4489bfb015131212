// SPDX-License-Identifier: MIT
#include "solver/direct_contacts.hpp"

#include "contacts/rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Which of a contact's impulses a row is of.
enum Place : std::uint8_t { Normal0, Normal1, Tangent0, Tangent1, Rolling };

ConstraintRow& addDirectRow(JointRows& rows, RowKind kind, const Jacobian& j, real mass, real impulse)
{
    ConstraintRow& row = rows.rows[rows.count];
    RowVisit& visit = rows.visits[rows.count++];
    row = {};
    row.kind = kind;
    row.j = j;
    row.mass = mass;
    visit = {};
    visit.impulse = impulse;
    row.touches = kind == RowKind::Limit;
    visit.high = row.touches ? kUnlimited : real(0);
    return row;
}

}  // namespace

JointRows directRowsOf(const Contact& c, const Motion& a, const Motion& b, const StepContext& context,
                       std::vector<std::uint8_t>& places)
{
    JointRows rows;
    rows.rowA = c.rowA;
    rows.rowB = c.rowB;
    const ContactRow<real> row = rowOf(c, a, b, context);
    const Vec2 n = row.normal, t = perpendicular(n);
    int rowOfPoint[2] = {-1, -1};
    std::uint8_t normals = 0;
    for (int k = 0; k < c.count; ++k) {
        const PointRow<real>& p = row.points[k];
        if (!(p.normalInverse > 0) || isLeftToImpacts(c, k, a, b, context)) continue;
        rowOfPoint[k] = rows.count;
        normals = static_cast<std::uint8_t>(normals | 1u << rows.count);
        places.push_back(static_cast<std::uint8_t>(Normal0 + k));
        addDirectRow(rows, RowKind::Limit, {-n, n, -p.turnA, p.turnB}, p.normalMass, p.normalImpulse);
        rows.visits[rows.count - 1].bias = p.allowed + slackOfImpact(c, c.points[k], a, b, context);
    }
    for (int k = 0; k < c.count; ++k) {
        const PointRow<real>& p = row.points[k];
        if (rowOfPoint[k] < 0 || !(row.friction > 0) || !(p.tangentInverse > 0)) continue;
        places.push_back(static_cast<std::uint8_t>(Tangent0 + k));
        ConstraintRow& friction = addDirectRow(rows, RowKind::Motor, {-t, t, -p.slideA, p.slideB},
                                               1 / p.tangentInverse, p.tangentImpulse);
        friction.pressedBy = static_cast<std::uint8_t>(1u << rowOfPoint[k]);
        friction.most = row.friction;
        rows.visits[rows.count - 1].bias = row.surfaceSpeed;
    }
    const real turn = a.invInertia + b.invInertia;
    if (normals != 0 && turn > 0 && (c.rolling > 0 || c.rollingImpulse != 0)) {
        places.push_back(Rolling);
        ConstraintRow& rolling = addDirectRow(rows, RowKind::Motor, {{}, {}, -1, 1}, turn, c.rollingImpulse);
        rolling.pressedBy = normals;
        rolling.most = c.rolling;
        rolling.angular = true;
    }
    return rows;
}

void storeDirectRows(const JointRows& rows, const std::uint8_t*& place, Contact& c)
{
    for (int i = 0; i < rows.count; ++i) {
        const real impulse = rows.visits[i].impulse;
        switch (*place++) {
        case Normal0:
        case Normal1:
            c.points[place[-1] - Normal0].normalImpulse = impulse;
            break;
        case Tangent0:
        case Tangent1:
            c.points[place[-1] - Tangent0].tangentImpulse = impulse;
            break;
        default:
            c.rollingImpulse = impulse;
        }
    }
}

JointRows pushRowsOf(const Contact& c, const Motion& a, const Motion& b, const StepContext& context,
                     ClampCounts& clamps, bool& any)
{
    const ContactRow<real> row = rowOf(c, a, b, context);
    JointRows rows;
    rows.rowA = c.rowA;
    rows.rowB = c.rowB;
    for (int k = 0; k < c.count; ++k) {
        const PointRow<real>& point = row.points[k];
        if (!(point.normalInverse > 0)) continue;
        addDirectRow(rows, RowKind::Limit, {-row.normal, row.normal, -point.turnA, point.turnB},
                     point.normalMass, 0);
        real& bias = rows.visits[rows.count - 1].bias;
        bias = pushBiasOf(c.points[k].gap, c.restGap, context, clamps);
        any = any || bias < 0;
    }
    return rows;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
