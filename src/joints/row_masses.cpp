// SPDX-License-Identifier: MIT
// Effective masses of the rows of a joint, and those of its rigid ones together.

#include "joints/row_masses.hpp"

#include <tamias2d/math/scalar.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// The inverse of a symmetric block of up to three rows. A row that nothing moves, or that others
// already settle, gets no impulse.
void invertBlock(const real (&k)[3][3], int count, real (&inverse)[3][3])
{
    real lower[3][3] = {}, pivot[3] = {};
    for (int i = 0; i < count; ++i) {
        for (int c = 0; c < i; ++c) {
            real sum = k[i][c];
            for (int m = 0; m < c; ++m) sum -= lower[i][m] * lower[c][m] * pivot[m];
            lower[i][c] = pivot[c] > 0 ? sum / pivot[c] : real(0);
        }
        real sum = k[i][i];
        for (int m = 0; m < i; ++m) sum -= lower[i][m] * lower[i][m] * pivot[m];
        pivot[i] = sum > real(1e-5) * k[i][i] ? sum : real(0);
    }
    for (int column = 0; column < count; ++column) {
        real x[3] = {};
        for (int i = 0; i < count; ++i) {
            x[i] = i == column ? real(1) : real(0);
            for (int m = 0; m < i; ++m) x[i] -= lower[i][m] * x[m];
        }
        for (int i = 0; i < count; ++i) x[i] = pivot[i] > 0 ? x[i] / pivot[i] : real(0);
        for (int i = count - 1; i >= 0; --i)
            for (int m = i + 1; m < count; ++m) x[i] -= pivot[i] > 0 ? lower[m][i] * x[m] : real(0);
        for (int i = 0; i < count; ++i) inverse[i][column] = x[i];
    }
}

}  // namespace

void prepareRows(JointRows& joint, const Table<Motion>& motions)
{
    const Motion &a = motions[joint.rowA], &b = motions[joint.rowB];
    joint.reach = maximum(a.extent, b.extent);
    for (int i = 0; i < joint.count; ++i)
        joint.rows[i].mass = complianceAlong(joint.rows[i].j, joint.rows[i].j, a, b);
    real k[3][3] = {};
    for (int i = 0; i < joint.rigid; ++i)
        for (int c = 0; c < joint.rigid; ++c)
            k[i][c] = complianceAlong(joint.rows[i].j, joint.rows[c].j, a, b);
    for (int m = 0; joint.more && m < joint.more->count; ++m) {
        const Motion& body = motions[joint.more->rows[m]];
        joint.reach = maximum(joint.reach, body.extent);
        for (int i = 0; i < joint.count; ++i) joint.rows[i].mass += complianceOf(*joint.more, i, i, m, body);
        for (int i = 0; i < joint.rigid; ++i)
            for (int c = 0; c < joint.rigid; ++c) k[i][c] += complianceOf(*joint.more, i, c, m, body);
    }
    invertBlock(k, joint.rigid, joint.inverse);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
