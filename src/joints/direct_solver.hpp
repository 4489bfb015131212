// SPDX-License-Identifier: MIT
// Newton's method on the impulses of a group. Each row answers a velocity by the impulse
//     clamp(before - (J v + b)/gamma, low, high)
// which for gamma = 0 would be the rigid row; a small gamma keeps redundant rows apart, and as it acts on the
// change of an impulse only, nothing sags.
#pragma once

#include "joints/direct_rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// What a row answers: its impulse is `at - slope * (J v)`, held within its bounds.
struct DirectAnswer {
    double at = 0, slope = 0;
};

/// How much rows give way: gamma over the effective mass inverted.
struct DirectGammas {
    static constexpr double kRigid = 1e-7, kRope = 1e-6, kBounded = 1e-2, kTouch = 1e-6, kRub = 1e-6;

    double ropes = kRope;  // of limits that bear loads
    double looseness = 1;  // times those of contacts

    double of(const ConstraintRow& row) const
    {
        if (row.touches) return looseness * kTouch;
        if (row.pressedBy != 0) return looseness * kRub;
        if (row.kind == RowKind::Rigid) return kRigid;
        return row.bears ? ropes : kBounded;
    }
    DirectAnswer answer(const ConstraintRow& row, const RowVisit& visit, double before) const
    {
        if (row.kind == RowKind::Spring)
            return {-static_cast<double>(visit.push), static_cast<double>(visit.give)};
        const double gamma = of(row) * static_cast<double>(row.mass);
        if (!(gamma > 0)) return {};
        return {before - static_cast<double>(visit.bias) / gamma, 1 / gamma};
    }
};

/// One solve of a group, from the velocities of the tick and back to them.
class DirectSolver : DirectRows {
public:
    explicit DirectSolver(const DirectRows& rows) : DirectRows(rows) {}

    bool solve(const std::vector<BodyMotion<real>>& velocities);
    void store(std::vector<BodyMotion<real>>& velocities, real& change);

private:
    static constexpr int kRepeats = 3;  // of the whole, each from the impulses of the last

    // Of each row, two bits.
    enum RowState : unsigned { Free, AtLow, AtHigh, Together };

    // direct.cpp: from the tick and back.
    void load(const std::vector<BodyMotion<real>>& velocities);
    void takeBack();
    void boundFrictions();

    // direct_stages.cpp: from soft rows to hard ones.
    void takeGammas(const DirectGammas& gammas);
    bool repeat(int times);
    bool solveContacts();
    double violation();
    bool hasRopes();
    bool soften(const std::vector<BodyMotion<real>>& velocities);

    // direct_loads.cpp: of all impulses that do the same, the least.
    bool takeLeastLoads();
    void findBearing();
    void relax();
    double partToBounds() const;

    // direct_newton.cpp: Newton's method, for one set of impulses before.
    bool converge();
    double enough(double left) const;
    bool answer();
    void answerPair(std::size_t j, int second, const double (&wanted)[JointRows::kMost]);
    double wantedBy(std::size_t j, int i) const;
    void residual(std::vector<double>& out);
    void move(double part);
    double descent();
    void shorten();

    // direct_matrix.cpp: its matrix.
    bool factor();
    void addRows(std::size_t j);
    void addPair(std::size_t j, int second);
    void addRow(const Jacobian& jacobian, int nodeA, int nodeB, double weight);
    void addMore(std::size_t j, int i, double weight);

    bool guarded_ = false;  // does a tie at a distance resist turning?
    DirectGammas gammas_;
    int steps_ = 0;  // of Newton's method, in all
    bool turns_ = false;  // is there a force of two rows at its bound?
};

// The impulse that a row answers to the velocity at hand, were it not for its bounds.
TAMIAS_INLINE double DirectSolver::wantedBy(std::size_t j, int i) const
{
    const JointRows& rows = joint(j);
    const DirectAnswer a = gammas_.answer(rows.rows[i], rows.visits[i], before(j, i));
    return a.at - a.slope * speedOf(j, i);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
