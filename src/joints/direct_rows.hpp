// SPDX-License-Identifier: MIT
// The rows of a group that is solved at once, in the space of the velocities of its bodies: three numbers a
// node.
#pragma once

#include "joints/direct_group.hpp"
#include "math/lane.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// What a row does to the two bodies of its joint. A locked axis takes no part: its row of the Jacobian is
/// left out, its mass any.
inline void fillJacobian(const Jacobian& j, const Motion& a, const Motion& b, double (&onA)[3],
                         double (&onB)[3])
{
    onA[0] = a.invMass.x > 0 ? static_cast<double>(j.linearA.x) : 0;
    onA[1] = a.invMass.y > 0 ? static_cast<double>(j.linearA.y) : 0;
    onA[2] = a.invInertia > 0 ? static_cast<double>(j.turnA) : 0;
    onB[0] = b.invMass.x > 0 ? static_cast<double>(j.linearB.x) : 0;
    onB[1] = b.invMass.y > 0 ? static_cast<double>(j.linearB.y) : 0;
    onB[2] = b.invInertia > 0 ? static_cast<double>(j.turnB) : 0;
}

/// And to one beyond two.
inline void fillPart(const ConstraintRows::Part& part, const Motion& m, double (&on)[3])
{
    on[0] = m.invMass.x > 0 ? static_cast<double>(part.linear.x) : 0;
    on[1] = m.invMass.y > 0 ? static_cast<double>(part.linear.y) : 0;
    on[2] = m.invInertia > 0 ? static_cast<double>(part.turn) : 0;
}

inline void fillMasses(const Motion& m, double (&mass)[3])
{
    const real inverse[3] = {m.invMass.x, m.invMass.y, m.invInertia};
    for (int i = 0; i < 3; ++i) mass[i] = inverse[i] > 0 ? 1 / static_cast<double>(inverse[i]) : 1;
}

/// The group, the joints among which it has its own, and its bodies.
struct DirectRows {
    DirectGroup& group;
    std::vector<JointRows>& all;
    const Table<Motion>& motions;

    /// The joints, then the contacts.
    std::size_t count() const { return group.joints.size() + group.contacts.size(); }
    const JointRows& joint(std::size_t j) const
    {
        const std::size_t joints = group.joints.size();
        return j < joints ? all[group.joints[j]] : group.contacts[j - joints];
    }
    JointRows& joint(std::size_t j)
    {
        const std::size_t joints = group.joints.size();
        return j < joints ? all[group.joints[j]] : group.contacts[j - joints];
    }
    double& impulse(std::size_t j, int i) { return group.impulses[placeOf(j, i)]; }
    double before(std::size_t j, int i) const { return group.before[placeOf(j, i)]; }
    int moreNode(std::size_t j, int k) const
    {
        return group.moreNodes[group.moreFrom[j] + static_cast<std::size_t>(k)];
    }

    /// The speed along a direction of the two bodies of a joint, and along a row of all that it has, at the
    /// velocities at hand.
    double speed(std::size_t j, const Jacobian& direction) const;
    double speedOf(std::size_t j, int i) const;

    /// Adds an amount along them in the space of velocities.
    void addAlong(std::size_t j, const Jacobian& direction, double amount, std::vector<double>& out) const;
    void addAlongRow(std::size_t j, int i, double amount, std::vector<double>& out) const;

    /// Where the impulse of a row is, and the reverse.
    static std::size_t placeOf(std::size_t j, int i)
    {
        return j * JointRows::kMost + static_cast<std::size_t>(i);
    }
    static std::size_t jointAt(std::size_t place) { return place / JointRows::kMost; }
    static int rowAt(std::size_t place) { return static_cast<int>(place % JointRows::kMost); }

private:
    double speedOfMore(std::size_t j, int i) const;
    void addAlongMore(std::size_t j, int i, double amount, std::vector<double>& out) const;
};

inline double DirectRows::speed(std::size_t j, const Jacobian& direction) const
{
    const auto part = [&](int node, std::uint32_t motion, Vec2 linear, real turn) {
        const double spin = static_cast<double>(turn);
        if (node < 0) {
            const Motion& m = motions[motion];
            return static_cast<double>(dot(linear, m.velocity)) + spin * static_cast<double>(m.spin);
        }
        const double* v = &group.velocity[3 * static_cast<std::size_t>(node)];
        return static_cast<double>(linear.x) * v[0] + static_cast<double>(linear.y) * v[1] + spin * v[2];
    };
    const JointRows& rows = joint(j);
    const auto [a, b] = group.nodes[j];
    return part(a, rows.rowA, direction.linearA, direction.turnA) +
           part(b, rows.rowB, direction.linearB, direction.turnB);
}

TAMIAS_INLINE double DirectRows::speedOf(std::size_t j, int i) const
{
    const JointRows& rows = joint(j);
    const double pair = speed(j, rows.rows[i].j);
    return rows.more ? pair + speedOfMore(j, i) : pair;
}

TAMIAS_INLINE void DirectRows::addAlong(std::size_t j, const Jacobian& direction, double amount,
                                        std::vector<double>& out) const
{
    const JointRows& rows = joint(j);
    const auto [nodeA, nodeB] = group.nodes[j];
    double onA[3], onB[3];
    fillJacobian(direction, motions[rows.rowA], motions[rows.rowB], onA, onB);
    for (std::size_t c = 0; c < 3; ++c) {
        if (nodeA >= 0) out[3 * static_cast<std::size_t>(nodeA) + c] += onA[c] * amount;
        if (nodeB >= 0) out[3 * static_cast<std::size_t>(nodeB) + c] += onB[c] * amount;
    }
}

TAMIAS_INLINE void DirectRows::addAlongRow(std::size_t j, int i, double amount,
                                           std::vector<double>& out) const
{
    const JointRows& rows = joint(j);
    addAlong(j, rows.rows[i].j, amount, out);
    if (rows.more) addAlongMore(j, i, amount, out);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
