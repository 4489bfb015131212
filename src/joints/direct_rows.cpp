// SPDX-License-Identifier: MIT
// Rows of joints of more than two bodies.

#include "joints/direct_rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

double DirectRows::speedOfMore(std::size_t j, int i) const
{
    const MoreBodies& more = *joint(j).more;
    double sum = 0;
    for (int k = 0; k < more.count; ++k) {
        const ConstraintRows::Part& part = more.parts[i][k];
        const Motion& m = motions[more.rows[k]];
        const int node = moreNode(j, k);
        double v[3] = {static_cast<double>(m.velocity.x), static_cast<double>(m.velocity.y),
                       static_cast<double>(m.spin)};
        for (std::size_t c = 0; node >= 0 && c < 3; ++c)
            v[c] = group.velocity[3 * static_cast<std::size_t>(node) + c];
        sum += static_cast<double>(part.linear.x) * v[0] + static_cast<double>(part.linear.y) * v[1] +
               static_cast<double>(part.turn) * v[2];
    }
    return sum;
}

void DirectRows::addAlongMore(std::size_t j, int i, double amount, std::vector<double>& out) const
{
    const MoreBodies& more = *joint(j).more;
    for (int k = 0; k < more.count; ++k) {
        const int node = moreNode(j, k);
        if (node < 0) continue;
        double on[3];
        fillPart(more.parts[i][k], motions[more.rows[k]], on);
        for (std::size_t c = 0; c < 3; ++c) out[3 * static_cast<std::size_t>(node) + c] += on[c] * amount;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
