// SPDX-License-Identifier: MIT
// Newton's method on the impulses of a group. Each row answers a velocity by the impulse
//     clamp(before - (J v + b)/gamma, low, high)
// which for gamma = 0 would be the rigid row; a small gamma keeps redundant rows apart, and as it acts on the
// change of an impulse only, nothing sags.

#include "joints/direct.hpp"

#include "math/lane.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// gamma over the effective mass inverted
constexpr double kRigid = 1e-7, kRope = 1e-6, kBounded = 1e-2, kTouch = 1e-6, kRub = 1e-6;
constexpr int kMostSteps = 40;  // of Newton's method, for one set of impulses before
constexpr int kMostOfAll = 60;  // of them, where there are contacts: then those do not get harder
constexpr double kSame = 1e-4;  // times what is negligible: a step of Newton's method that is none
constexpr double kLooseness[] = {1e4, 1e3, 1e2, 1e1, 1};  // times the gammas of contacts, one after the other
constexpr int kMostTrials = 20;  // of the length of a step
constexpr double kEven = 1e-6, kEvenEnough = 1e-1;  // of the descent at its start, there; with contacts
constexpr double kUlp = static_cast<double>(std::numeric_limits<real>::epsilon());
constexpr double kTurned = 1e-9;  // of a speed: what may be left where a force turns under its bound
constexpr double kLeft = 1e-5;  // of the speeds: where rows that bear next to nothing go from bound to bound
constexpr double kRough = 1e-4;  // the same on the way to a harder rope
constexpr int kRepeats = 3;  // of the whole, each from the impulses of the last

// Of each row, two bits.
enum RowState : unsigned { Free, AtLow, AtHigh, Together };

// What a row answers: its impulse is `at - slope * (J v)`, held within its bounds.
struct Answer {
    double at = 0, slope = 0;
};

double gammaOf(const ConstraintRow& row, double ropes, double looseness)
{
    if (row.touches) return looseness * kTouch;
    if (row.pressedBy != 0) return looseness * kRub;
    if (row.kind == RowKind::Rigid) return kRigid;
    return row.bears ? ropes : kBounded;
}

Answer answerOf(const ConstraintRow& row, const RowVisit& visit, double before, double ropes,
                double looseness)
{
    if (row.kind == RowKind::Spring)
        return {-static_cast<double>(visit.push), static_cast<double>(visit.give)};
    const double gamma = gammaOf(row, ropes, looseness) * static_cast<double>(row.mass);
    if (!(gamma > 0)) return {};
    return {before - static_cast<double>(visit.bias) / gamma, 1 / gamma};
}

class DirectSolver {
public:
    DirectSolver(DirectGroup& group, std::vector<JointRows>& all, const Table<Motion>& motions)
        : group_(group), all_(all), motions_(motions)
    {
    }

    bool solve(const std::vector<BodyMotion<real>>& velocities);
    void store(std::vector<BodyMotion<real>>& velocities, real& change);

private:
    DirectGroup& group_;
    std::vector<JointRows>& all_;
    const Table<Motion>& motions_;

    // The joints, then the contacts.
    std::size_t count() const { return group_.joints.size() + group_.contacts.size(); }
    const JointRows& joint(std::size_t j) const
    {
        const std::size_t joints = group_.joints.size();
        return j < joints ? all_[group_.joints[j]] : group_.contacts[j - joints];
    }
    JointRows& joint(std::size_t j)
    {
        const std::size_t joints = group_.joints.size();
        return j < joints ? all_[group_.joints[j]] : group_.contacts[j - joints];
    }
    double& impulse(std::size_t j, int i)
    {
        return group_.impulses[j * JointRows::kMost + static_cast<std::size_t>(i)];
    }

    void load(const std::vector<BodyMotion<real>>& velocities);
    double speed(std::size_t j, const Jacobian& direction) const;
    void addAlong(std::size_t j, const Jacobian& direction, double amount, std::vector<double>& out) const;
    double speedOf(std::size_t j, int i) const;
    void addAlongRow(std::size_t j, int i, double amount, std::vector<double>& out) const;
    double speedOfMore(std::size_t j, int i) const;
    void addAlongMore(std::size_t j, int i, double amount, std::vector<double>& out) const;
    void addMore(std::size_t j, int i, double weight);
    int moreNode(std::size_t j, int k) const
    {
        return group_.moreNodes[group_.moreFrom[j] + static_cast<std::size_t>(k)];
    }
    double wantedBy(std::size_t j, int i) const;
    void boundFrictions();
    bool answer();
    void answerPair(std::size_t j, int second, const double (&wanted)[JointRows::kMost]);
    bool factor();
    void addRows(std::size_t j);
    void addPair(std::size_t j, int second);
    void residual(std::vector<double>& out);
    void move(double part);
    double descent();
    void shorten();
    bool hasRopes();
    bool solveContacts();
    double violation();
    bool soften(const std::vector<BodyMotion<real>>& velocities);
    bool repeat(int times);
    bool converge();
    double enough(double left) const;
    void addRow(const Jacobian& jacobian, int nodeA, int nodeB, double weight);

    void takeBack();
    void takeGammas(double ropes, double looseness);

    bool guarded_ = false;  // does a tie at a distance resist turning?
    double ropeGamma_ = kRope;  // over the effective mass inverted, of limits that bear loads
    double looseness_ = 1;  // times the gammas of contacts
    int steps_ = 0;  // of Newton's method, in all
    bool turns_ = false;  // is there a force of two rows at its bound?
};

// A locked axis takes no part: its row of the Jacobian is left out, its mass any.
void fillJacobian(const Jacobian& j, const Motion& a, const Motion& b, double (&onA)[3], double (&onB)[3])
{
    onA[0] = a.invMass.x > 0 ? static_cast<double>(j.linearA.x) : 0;
    onA[1] = a.invMass.y > 0 ? static_cast<double>(j.linearA.y) : 0;
    onA[2] = a.invInertia > 0 ? static_cast<double>(j.turnA) : 0;
    onB[0] = b.invMass.x > 0 ? static_cast<double>(j.linearB.x) : 0;
    onB[1] = b.invMass.y > 0 ? static_cast<double>(j.linearB.y) : 0;
    onB[2] = b.invInertia > 0 ? static_cast<double>(j.turnB) : 0;
}

void fillPart(const ConstraintRows::Part& part, const Motion& m, double (&on)[3])
{
    on[0] = m.invMass.x > 0 ? static_cast<double>(part.linear.x) : 0;
    on[1] = m.invMass.y > 0 ? static_cast<double>(part.linear.y) : 0;
    on[2] = m.invInertia > 0 ? static_cast<double>(part.turn) : 0;
}

void fillMasses(const Motion& m, double (&mass)[3])
{
    const real inverse[3] = {m.invMass.x, m.invMass.y, m.invInertia};
    for (int i = 0; i < 3; ++i) mass[i] = inverse[i] > 0 ? 1 / static_cast<double>(inverse[i]) : 1;
}

void DirectSolver::load(const std::vector<BodyMotion<real>>& velocities)
{
    const std::size_t nodes = group_.rows.size();
    group_.start.resize(3 * nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
        // What the kicks have rounded is still known where no visit has changed it.
        const auto known = [](real velocity, double fine) {
            return static_cast<real>(fine) == velocity ? fine : static_cast<double>(velocity);
        };
        const Motion& m = motions_[group_.rows[n]];
        group_.start[3 * n] = known(velocities[n].velocity.x, m.fineVelocity.x);
        group_.start[3 * n + 1] = known(velocities[n].velocity.y, m.fineVelocity.y);
        group_.start[3 * n + 2] = known(velocities[n].spin, m.fineSpin);
    }
    group_.velocity = group_.start;
    guarded_ = std::any_of(group_.joints.begin(), group_.joints.end(),
                           [&](std::uint32_t j) { return all_[j].turnMass > 0; });
    if (guarded_) takeBack();
    group_.states.assign(count(), 0xffff);
    group_.factored.clear();
    group_.impulses.assign(count() * JointRows::kMost, 0);
    for (std::size_t j = 0; j < count(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            impulse(j, i) = static_cast<double>(joint(j).visits[i].impulse);
    group_.before = group_.impulses;
    boundFrictions();
}

// What presses bounds what rubs: for one set of impulses before, by those.
void DirectSolver::boundFrictions()
{
    const std::size_t joints = group_.joints.size();
    for (std::size_t j = joints; j < count(); ++j) {
        JointRows& rows = joint(j);
        for (int i = 0; i < rows.count; ++i) {
            if (rows.rows[i].pressedBy == 0) continue;
            double load = 0;
            for (int k = 0; k < rows.count; ++k)
                if ((rows.rows[i].pressedBy >> k & 1) != 0)
                    load += group_.before[j * JointRows::kMost + static_cast<std::size_t>(k)];
            rows.visits[i].high = rows.rows[i].most * static_cast<real>(load);
            rows.visits[i].low = -rows.visits[i].high;
        }
    }
}

// The velocities without what the group itself has changed in this half of the tick.
void DirectSolver::takeBack()
{
    std::vector<double>& given = group_.given;
    if (group_.begins) {  // what was carried
        given.assign(group_.start.size(), 0);
        for (std::size_t j = 0; j < count(); ++j)
            for (int i = 0; i < joint(j).count; ++i)
                addAlongRow(j, i, static_cast<double>(joint(j).visits[i].impulse), given);
        for (std::size_t n = 0; n < group_.rows.size(); ++n) {
            double mass[3];
            fillMasses(motions_[group_.rows[n]], mass);
            for (std::size_t i = 0; i < 3; ++i) given[3 * n + i] /= mass[i];
        }
    }
    for (std::size_t i = 0; i < given.size(); ++i) group_.start[i] -= given[i];
}

// Adds an amount along a direction in the space of velocities.
TAMIAS_INLINE void DirectSolver::addAlong(std::size_t j, const Jacobian& direction, double amount,
                                          std::vector<double>& out) const
{
    const JointRows& rows = joint(j);
    const auto [nodeA, nodeB] = group_.nodes[j];
    double onA[3], onB[3];
    fillJacobian(direction, motions_[rows.rowA], motions_[rows.rowB], onA, onB);
    for (std::size_t c = 0; c < 3; ++c) {
        if (nodeA >= 0) out[3 * static_cast<std::size_t>(nodeA) + c] += onA[c] * amount;
        if (nodeB >= 0) out[3 * static_cast<std::size_t>(nodeB) + c] += onB[c] * amount;
    }
}

double DirectSolver::speed(std::size_t j, const Jacobian& direction) const
{
    const auto part = [&](int node, std::uint32_t motion, Vec2 linear, real turn) {
        const double spin = static_cast<double>(turn);
        if (node < 0) {
            const Motion& m = motions_[motion];
            return static_cast<double>(dot(linear, m.velocity)) + spin * static_cast<double>(m.spin);
        }
        const double* v = &group_.velocity[3 * static_cast<std::size_t>(node)];
        return static_cast<double>(linear.x) * v[0] + static_cast<double>(linear.y) * v[1] + spin * v[2];
    };
    const JointRows& rows = joint(j);
    const auto [a, b] = group_.nodes[j];
    return part(a, rows.rowA, direction.linearA, direction.turnA) +
           part(b, rows.rowB, direction.linearB, direction.turnB);
}

// Likewise, of a row with all bodies that it has.
TAMIAS_INLINE void DirectSolver::addAlongRow(std::size_t j, int i, double amount,
                                             std::vector<double>& out) const
{
    const JointRows& rows = joint(j);
    addAlong(j, rows.rows[i].j, amount, out);
    if (rows.more) addAlongMore(j, i, amount, out);
}

void DirectSolver::addAlongMore(std::size_t j, int i, double amount, std::vector<double>& out) const
{
    const MoreBodies& more = *joint(j).more;
    for (int k = 0; k < more.count; ++k) {
        const int node = moreNode(j, k);
        if (node < 0) continue;
        double on[3];
        fillPart(more.parts[i][k], motions_[more.rows[k]], on);
        for (std::size_t c = 0; c < 3; ++c) out[3 * static_cast<std::size_t>(node) + c] += on[c] * amount;
    }
}

TAMIAS_INLINE double DirectSolver::speedOf(std::size_t j, int i) const
{
    const JointRows& rows = joint(j);
    const double pair = speed(j, rows.rows[i].j);
    return rows.more ? pair + speedOfMore(j, i) : pair;
}

double DirectSolver::speedOfMore(std::size_t j, int i) const
{
    const MoreBodies& more = *joint(j).more;
    double sum = 0;
    for (int k = 0; k < more.count; ++k) {
        const ConstraintRows::Part& part = more.parts[i][k];
        const Motion& m = motions_[more.rows[k]];
        const int node = moreNode(j, k);
        double v[3] = {static_cast<double>(m.velocity.x), static_cast<double>(m.velocity.y),
                       static_cast<double>(m.spin)};
        for (std::size_t c = 0; node >= 0 && c < 3; ++c)
            v[c] = group_.velocity[3 * static_cast<std::size_t>(node) + c];
        sum += static_cast<double>(part.linear.x) * v[0] + static_cast<double>(part.linear.y) * v[1] +
               static_cast<double>(part.turn) * v[2];
    }
    return sum;
}

// The impulse that a row answers to the velocity at hand, were it not for its bounds.
TAMIAS_INLINE double DirectSolver::wantedBy(std::size_t j, int i) const
{
    const JointRows& rows = joint(j);
    const double before = group_.before[j * JointRows::kMost + static_cast<std::size_t>(i)];
    const Answer a = answerOf(rows.rows[i], rows.visits[i], before, ropeGamma_, looseness_);
    return a.at - a.slope * speedOf(j, i);
}

// The impulses that the rows answer to the velocity at hand; true if each is as free as it was, or at the
// same bound.
bool DirectSolver::answer()
{
    bool same = true;
    turns_ = false;
    for (std::size_t j = 0; j < count(); ++j) {
        JointRows& rows = joint(j);
        double wanted[JointRows::kMost];
        std::uint16_t states = 0;
        for (int i = 0; i < rows.count; ++i) {
            const ConstraintRow& row = rows.rows[i];
            const RowVisit& visit = rows.visits[i];
            wanted[i] = wantedBy(j, i);
            const double low = static_cast<double>(visit.low), high = static_cast<double>(visit.high);
            impulse(j, i) = clamp(wanted[i], low, high);
            const bool isHigh = wanted[i] >= high || !(low < high);
            const unsigned state = isHigh ? AtHigh : wanted[i] <= low ? AtLow : Free;
            states = static_cast<std::uint16_t>(states | state << 2 * i);
            if (!row.pairBound) continue;
            const bool bound = length(DVec2{wanted[i - 1], wanted[i]}) > high;
            answerPair(j, i, wanted);
            states = static_cast<std::uint16_t>((states & ~(15u << 2 * (i - 1))) |
                                                (bound ? Together * 5u : Free * 5u) << 2 * (i - 1));
            turns_ = turns_ || bound;
        }
        same = same && states == group_.states[j];
        group_.states[j] = states;
    }
    return same;
}

// The two impulses of one force, whose strength is bounded.
void DirectSolver::answerPair(std::size_t j, int second, const double (&wanted)[JointRows::kMost])
{
    const DVec2 both{wanted[second - 1], wanted[second]};
    const double strength = length(both), high = static_cast<double>(joint(j).visits[second].high);
    const double part = strength > high ? high / strength : 1;
    impulse(j, second - 1) = part * both.x;
    impulse(j, second) = part * both.y;
}

TAMIAS_INLINE void addProduct(BlockLdl::Block& block, double weight, const double (&x)[3],
                              const double (&y)[3])
{
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block.a[3 * r + c] += weight * x[r] * y[c];
}

// Of two nodes, if something moves both; a body that is alone in its joint is there twice.
TAMIAS_INLINE void addBetween(BlockLdl& matrix, double weight, int nodeA, const double (&onA)[3], int nodeB,
                              const double (&onB)[3])
{
    if (nodeA < 0 || nodeB < 0 || nodeA == nodeB) return;
    const auto [block, transposed] = matrix.between(nodeA, nodeB);
    if (transposed)
        addProduct(*block, weight, onB, onA);
    else
        addProduct(*block, weight, onA, onB);
}

void DirectSolver::addRow(const Jacobian& jacobian, int nodeA, int nodeB, double weight)
{
    static const Motion ground;
    double onA[3], onB[3];
    const Motion& a = nodeA < 0 ? ground : motions_[group_.rows[static_cast<std::size_t>(nodeA)]];
    const Motion& b = nodeB < 0 ? ground : motions_[group_.rows[static_cast<std::size_t>(nodeB)]];
    fillJacobian(jacobian, a, b, onA, onB);
    if (nodeA >= 0) addProduct(group_.matrix.diagonal(nodeA), weight, onA, onA);
    if (nodeB >= 0) addProduct(group_.matrix.diagonal(nodeB), weight, onB, onB);
    addBetween(group_.matrix, weight, nodeA, onA, nodeB, onB);
}

// What the bodies beyond two add to that.
void DirectSolver::addMore(std::size_t j, int i, double weight)
{
    const JointRows& rows = joint(j);
    const MoreBodies& more = *rows.more;
    int nodes[ConstraintRows::kMostBodies] = {group_.nodes[j].first, group_.nodes[j].second};
    double on[ConstraintRows::kMostBodies][3];
    fillJacobian(rows.rows[i].j, motions_[rows.rowA], motions_[rows.rowB], on[0], on[1]);
    for (int k = 0; k < more.count; ++k) {
        const int p = 2 + k;
        nodes[p] = moreNode(j, k);
        fillPart(more.parts[i][k], motions_[more.rows[k]], on[p]);
        if (nodes[p] >= 0) addProduct(group_.matrix.diagonal(nodes[p]), weight, on[p], on[p]);
        for (int q = 0; q < p; ++q) addBetween(group_.matrix, weight, nodes[q], on[q], nodes[p], on[p]);
    }
}

// Factors are of the gammas with which they were made.
void DirectSolver::takeGammas(double ropes, double looseness)
{
    ropeGamma_ = ropes;
    looseness_ = looseness;
    group_.factored.clear();
}

bool DirectSolver::factor()
{
    if (group_.factored == group_.states && !turns_) return true;
    group_.matrix.clear();
    for (std::size_t n = 0; n < group_.rows.size(); ++n) {
        double mass[3];
        fillMasses(motions_[group_.rows[n]], mass);
        for (int i = 0; i < 3; ++i) group_.matrix.diagonal(static_cast<int>(n)).a[4 * i] = mass[i];
        if (!group_.turnStiffness.empty())
            group_.matrix.diagonal(static_cast<int>(n)).a[8] += group_.turnStiffness[n];
    }
    for (std::size_t j = 0; j < count(); ++j) addRows(j);
    group_.factored = group_.states;
    return group_.matrix.factor();
}

void DirectSolver::addRows(std::size_t j)
{
    const JointRows& rows = joint(j);
    if (rows.turnMass > 0)
        addRow(rows.across, group_.nodes[j].first, group_.nodes[j].second,
               static_cast<double>(rows.turnMass));
    for (int i = 0; i < rows.count; ++i) {
        const unsigned state = group_.states[j] >> 2 * i & 3u;
        if (state == Together && rows.rows[i].pairBound) addPair(j, i);
        if (state != Free) continue;
        const double slope = answerOf(rows.rows[i], rows.visits[i], 0, ropeGamma_, looseness_).slope;
        if (!(slope > 0)) continue;
        addRow(rows.rows[i].j, group_.nodes[j].first, group_.nodes[j].second, slope);
        if (rows.more) addMore(j, i, slope);
    }
}

// At its bound a force gives way across its direction only: what it turns by.
void DirectSolver::addPair(std::size_t j, int second)
{
    const JointRows& rows = joint(j);
    const ConstraintRow &x = rows.rows[second - 1], &y = rows.rows[second];
    const DVec2 force{impulse(j, second - 1), impulse(j, second)};
    const double strength = length(force);
    if (!(strength > 0)) return;
    const double part = strength / length(DVec2{wantedBy(j, second - 1), wantedBy(j, second)});
    const double slope = answerOf(y, rows.visits[second], 0, ropeGamma_, looseness_).slope * part;
    const auto alongX = static_cast<real>(-force.y / strength),
               alongY = static_cast<real>(force.x / strength);
    const Jacobian across{alongX * x.j.linearA + alongY * y.j.linearA,
                          alongX * x.j.linearB + alongY * y.j.linearB,
                          alongX * x.j.turnA + alongY * y.j.turnA, alongX * x.j.turnB + alongY * y.j.turnB};
    if (slope > 0) addRow(across, group_.nodes[j].first, group_.nodes[j].second, slope);
}

// M (start - v) + sum of J^T (impulse - impulse at hand): zero where the velocity is that of the impulses.
void DirectSolver::residual(std::vector<double>& out)
{
    out.resize(group_.start.size());
    for (std::size_t n = 0; n < group_.rows.size(); ++n) {
        double mass[3];
        fillMasses(motions_[group_.rows[n]], mass);
        for (std::size_t i = 0; i < 3; ++i)
            out[3 * n + i] = mass[i] * (group_.start[3 * n + i] - group_.velocity[3 * n + i]);
        if (!group_.turnStiffness.empty())
            out[3 * n + 2] -= group_.turnStiffness[n] * group_.velocity[3 * n + 2];
    }
    for (std::size_t j = 0; j < count(); ++j) {
        const JointRows& rows = joint(j);
        for (int i = 0; i < rows.count; ++i) {
            const double before = guarded_ ? 0 : static_cast<double>(rows.visits[i].impulse);
            addAlongRow(j, i, impulse(j, i) - before, out);
        }
        if (rows.turnMass > 0)
            addAlong(j, rows.across, -static_cast<double>(rows.turnMass) * speed(j, rows.across), out);
    }
}

void DirectSolver::move(double part)
{
    for (std::size_t i = 0; i < group_.step.size(); ++i) group_.velocity[i] += part * group_.step[i];
}

// How fast what is minimized falls along the step, at the velocity at hand.
double DirectSolver::descent()
{
    residual(group_.left);
    double sum = 0;
    for (std::size_t i = 0; i < group_.step.size(); ++i) sum += group_.left[i] * group_.step[i];
    return sum;
}

// Where bounds were met the whole step may lead uphill: goes back to where along it the lowest place is. The
// descent falls in straight pieces, so false position finds it; an end that stays twice counts half.
void DirectSolver::shorten()
{
    double end = descent();
    if (!(end < 0)) return;
    move(-1);
    answer();
    double begin = descent(), low = 0, high = 1, at = 0;
    const double enough = (group_.contacts.empty() ? kEven : kEvenEnough) * begin;
    int side = 0;
    for (int trial = 0; trial < kMostTrials && begin > end; ++trial) {
        const double next = low + (high - low) * begin / (begin - end);
        move(next - at);
        at = next;
        answer();
        const double now = descent();
        if (absolute(now) <= enough) return;
        if (now > 0) {
            low = at;
            begin = now;
            if (side > 0) end /= 2;
            side = 1;
        } else {
            high = at;
            end = now;
            if (side < 0) begin /= 2;
            side = -1;
        }
    }
}

double greatest(const std::vector<double>& numbers)
{
    double most = 0;
    for (const double x : numbers) most = maximum(most, absolute(x));
    return most;
}

bool DirectSolver::converge()
{
    answer();
    const double left = ropeGamma_ > kRope ? kRough : kLeft;
    for (int step = 0; step < kMostSteps; ++step) {
        ++steps_;
        if (!factor()) return false;
        residual(group_.step);
        group_.matrix.solve(group_.step);
        move(1);
        if (answer() && !turns_) return true;
        const double most = greatest(group_.step);
        shorten();
        if (most <= enough(left)) return true;
    }
    return false;
}

// A change of speeds that ends Newton's method.
double DirectSolver::enough(double left) const
{
    if (!group_.contacts.empty()) return kSame * looseness_ * group_.negligible;
    return turns_ ? kTurned : left * greatest(group_.velocity);
}

bool DirectSolver::solve(const std::vector<BodyMotion<real>>& velocities)
{
    load(velocities);
    takeGammas(kRope, 1);
    const bool solved =
        group_.contacts.empty() ? repeat(kRepeats) || (hasRopes() && soften(velocities)) : solveContacts();
    return solved && std::all_of(group_.velocity.begin(), group_.velocity.end(),
                                 [](double v) { return std::isfinite(v); });
}

// Where many contacts open and close, they give way at first, and then less and less, until that changes
// nothing more: so each begins near its answer. The hardest that was found counts.
bool DirectSolver::solveContacts()
{
    bool found = false;
    steps_ = 0;
    for (const double looseness : kLooseness) {
        if (steps_ >= kMostOfAll) break;
        takeGammas(kRope, looseness);
        group_.kept = group_.velocity;
        if (!converge()) {
            group_.velocity = group_.kept;
            group_.impulses = group_.before;
            break;
        }
        found = true;
        const double left = violation();
        group_.before = group_.impulses;
        boundFrictions();
        if (left <= group_.negligible) break;
    }
    return found;
}

// How fast what should not move does, at most: that is what changes impulses.
double DirectSolver::violation()
{
    double most = 0;
    for (std::size_t j = group_.joints.size(); j < count(); ++j) {
        const JointRows& rows = joint(j);
        for (int i = 0; i < rows.count; ++i) {
            const double change =
                impulse(j, i) - group_.before[j * JointRows::kMost + static_cast<std::size_t>(i)];
            const double gamma =
                gammaOf(rows.rows[i], ropeGamma_, looseness_) * static_cast<double>(rows.rows[i].mass);
            most = maximum(most, gamma * absolute(change));
        }
    }
    return most;
}

bool DirectSolver::hasRopes()
{
    for (std::size_t j = 0; j < count(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            if (joint(j).rows[i].bears) return true;
    return false;
}

// Ropes that give way as much as other limits do, and then less and less, as long as that can be solved.
bool DirectSolver::soften(const std::vector<BodyMotion<real>>& velocities)
{
    load(velocities);
    takeGammas(kBounded, 1);
    if (!repeat(1)) return false;
    while (ropeGamma_ > 2 * kRope) {
        takeGammas(ropeGamma_ / 10, 1);
        group_.kept = group_.velocity;
        if (repeat(1)) continue;
        group_.velocity = group_.kept;
        group_.impulses = group_.before;
        break;
    }
    return true;
}

// Newton's method from impulses to impulses; the last it found are at hand.
bool DirectSolver::repeat(int times)
{
    for (int i = 0; i < times; ++i) {
        if (!converge()) return false;
        group_.before = group_.impulses;
        boundFrictions();
    }
    return true;
}

void DirectSolver::store(std::vector<BodyMotion<real>>& velocities, real& change)
{
    if (guarded_)
        for (std::size_t i = 0; i < group_.given.size(); ++i)
            group_.given[i] = group_.velocity[i] - group_.start[i];
    group_.begins = false;
    // What the impulses make of the velocities, as those that are kept are the impulses.
    for (std::size_t j = 0; j < count(); ++j)
        for (int i = 0; i < joint(j).count; ++i)
            joint(j).visits[i].impulse = static_cast<real>(impulse(j, i));
    // What rounding takes from the momentum of one, the next gets that it does not shift by more than its own
    // rounding does: so the momentum of all is rounded once.
    double owedX = 0, owedY = 0;  // [kg*m/s]
    const auto rounded = [](double velocity, real inverse, double& owed) {
        const double given = owed * static_cast<double>(inverse);
        const bool takes = absolute(given) <= 2 * kUlp * absolute(velocity);
        const double exact = takes ? velocity + given : velocity;
        const real nearest = static_cast<real>(exact);
        owed = (takes ? 0 : owed) + (exact - static_cast<double>(nearest)) / static_cast<double>(inverse);
        return nearest;
    };
    for (std::size_t n = 0; n < group_.rows.size(); ++n) {
        const Motion& m = motions_[group_.rows[n]];
        const double* v = &group_.velocity[3 * n];
        const Vec2 linear{m.invMass.x > 0 ? rounded(v[0], m.invMass.x, owedX) : velocities[n].velocity.x,
                          m.invMass.y > 0 ? rounded(v[1], m.invMass.y, owedY) : velocities[n].velocity.y};
        const real spin = m.invInertia > 0 ? static_cast<real>(v[2]) : velocities[n].spin;
        change = maximum(change, maximum(length(linear - velocities[n].velocity),
                                         absolute(spin - velocities[n].spin) * m.extent));
        velocities[n] = {linear, spin};
    }
}

}  // namespace

void DirectGroup::build(const std::vector<JointRows>& all, const Table<Motion>& motions)
{
    rows.clear();
    const auto addRowsOf = [&](const JointRows& tie) {
        tie.eachRow([&](std::uint32_t row) {
            if (motions[row].moves()) rows.push_back(row);
        });
    };
    for (const std::uint32_t j : joints) addRowsOf(all[j]);
    for (const JointRows& contact : contacts) addRowsOf(contact);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    const auto nodeOf = [&](std::uint32_t row) {
        if (!motions[row].moves()) return -1;
        return static_cast<int>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
    };
    nodes.clear();
    moreNodes.clear();
    moreFrom.clear();
    edges.clear();
    const auto tie = [&](int a, int b) {
        if (a >= 0 && b >= 0 && a != b) edges.emplace_back(a, b);
    };
    const auto addNodesOf = [&](const JointRows& of) {
        nodes.emplace_back(nodeOf(of.rowA), nodeOf(of.rowB));
        tie(nodes.back().first, nodes.back().second);
        moreFrom.push_back(moreNodes.size());
        for (int k = 0; of.more && k < of.more->count; ++k) {
            const int node = nodeOf(of.more->rows[k]);
            tie(nodes.back().first, node);
            tie(nodes.back().second, node);
            for (std::size_t m = moreFrom.back(); m < moreNodes.size(); ++m) tie(moreNodes[m], node);
            moreNodes.push_back(node);
        }
    };
    for (const std::uint32_t j : joints) addNodesOf(all[j]);
    for (const JointRows& contact : contacts) addNodesOf(contact);
    const int count = static_cast<int>(rows.size());
    if (count == analyzedNodes && edges == analyzed) return;
    matrix.analyze(count, edges);
    analyzedNodes = count;
    analyzed.swap(edges);
}

real solveDirect(DirectGroup& group, std::vector<JointRows>& all, const Table<Motion>& motions,
                 std::vector<BodyMotion<real>>& velocities)
{
    DirectSolver solver(group, all, motions);
    if (!solver.solve(velocities)) return -1;
    real change = 0;
    solver.store(velocities, change);
    return change;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
