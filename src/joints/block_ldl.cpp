// SPDX-License-Identifier: MIT
#include "joints/block_ldl.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

using Block = BlockLdl::Block;

// out = x y
Block product(const Block& x, const Block& y)
{
    Block out;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            out.a[3 * r + c] =
                x.a[3 * r] * y.a[c] + x.a[3 * r + 1] * y.a[3 + c] + x.a[3 * r + 2] * y.a[6 + c];
    return out;
}

// target -= x y^T
void subtract(Block& target, const Block& x, const Block& y)
{
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            target.a[3 * r + c] -=
                x.a[3 * r] * y.a[3 * c] + x.a[3 * r + 1] * y.a[3 * c + 1] + x.a[3 * r + 2] * y.a[3 * c + 2];
}

// out -= x v
void subtract(double* out, const Block& x, const double* v)
{
    for (int r = 0; r < 3; ++r) out[r] -= x.a[3 * r] * v[0] + x.a[3 * r + 1] * v[1] + x.a[3 * r + 2] * v[2];
}

// out -= x^T v
void subtractTransposed(double* out, const Block& x, const double* v)
{
    for (int c = 0; c < 3; ++c) out[c] -= x.a[c] * v[0] + x.a[3 + c] * v[1] + x.a[6 + c] * v[2];
}

// The inverse of a symmetric positive block, by its own L D L^T; false if it is not positive.
bool invert(Block& block)
{
    double* a = block.a;
    const double d0 = a[0], l1 = a[3] / d0, l2 = a[6] / d0;
    const double d1 = a[4] - l1 * a[3], e = a[7] - l2 * a[3], l3 = e / d1;
    const double d2 = a[8] - l2 * a[6] - l3 * e;
    if (!(d0 > 0) || !(d1 > 0) || !(d2 > 0)) return false;
    const double w = l1 * l3 - l2;   // L^-1 has rows (1), (-l1, 1), (w, -l3, 1)
    const double i0 = 1 / d0, i1 = 1 / d1, i2 = 1 / d2;
    a[0] = i0 + l1 * l1 * i1 + w * w * i2;
    a[1] = a[3] = -l1 * i1 - w * l3 * i2;
    a[2] = a[6] = w * i2;
    a[4] = i1 + l3 * l3 * i2;
    a[5] = a[7] = -l3 * i2;
    a[8] = i2;
    return true;
}

void sortUnique(std::vector<int>& list)
{
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

void BlockLdl::analyze(int nodes, const std::vector<Edge>& edges)
{
    const auto count = static_cast<std::size_t>(nodes);
    std::vector<std::vector<int>> neighbors(count), columns;
    for (const auto& [a, b] : edges) {
        neighbors[static_cast<std::size_t>(a)].push_back(b);
        neighbors[static_cast<std::size_t>(b)].push_back(a);
    }
    for (std::vector<int>& list : neighbors) sortUnique(list);

    // The node with fewest neighbors goes first; those become neighbors of each other.
    order_.clear();
    places_.assign(count, -1);
    while (order_.size() < count) {
        std::size_t best = count;
        for (std::size_t i = 0; i < count; ++i)
            if (places_[i] < 0 && (best == count || neighbors[i].size() < neighbors[best].size())) best = i;
        places_[best] = static_cast<int>(order_.size());
        order_.push_back(static_cast<int>(best));
        const std::vector<int> column = neighbors[best];
        for (const int i : column) {
            std::vector<int>& list = neighbors[static_cast<std::size_t>(i)];
            list.insert(list.end(), column.begin(), column.end());
            sortUnique(list);
            std::erase_if(list, [&](int k) { return k == i || k == static_cast<int>(best); });
        }
        columns.push_back(column);
    }

    // Columns in terms of places, and the block that each product of a column changes.
    starts_.assign(1, 0);
    rows_.clear();
    for (std::vector<int>& column : columns) {
        for (int& i : column) i = places_[static_cast<std::size_t>(i)];
        std::sort(column.begin(), column.end());
        rows_.insert(rows_.end(), column.begin(), column.end());
        starts_.push_back(rows_.size());
    }
    targets_.clear();
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t p = starts_[k]; p < starts_[k + 1]; ++p)
            for (std::size_t q = starts_[k]; q < p; ++q) targets_.push_back(find(rows_[p], rows_[q]));
    lower_.resize(rows_.size());
    diagonals_.resize(count);
    work_.resize(3 * count);
}

std::size_t BlockLdl::find(int row, int column) const
{
    const auto c = static_cast<std::size_t>(column);
    const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(starts_[c]);
    const auto end = rows_.begin() + static_cast<std::ptrdiff_t>(starts_[c + 1]);
    return static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows_.begin());
}

void BlockLdl::clear()
{
    std::fill(lower_.begin(), lower_.end(), Block{});
    std::fill(diagonals_.begin(), diagonals_.end(), Block{});
}

std::pair<BlockLdl::Block*, bool> BlockLdl::between(int row, int column)
{
    const int i = places_[static_cast<std::size_t>(row)], k = places_[static_cast<std::size_t>(column)];
    const bool transposed = i < k;
    return {&lower_[transposed ? find(k, i) : find(i, k)], transposed};
}

bool BlockLdl::factor()
{
    std::size_t next = 0;
    for (std::size_t k = 0; k < diagonals_.size(); ++k) {
        if (!invert(diagonals_[k])) return false;
        const std::size_t begin = starts_[k], end = starts_[k + 1];
        scaled_.assign(lower_.begin() + static_cast<std::ptrdiff_t>(begin),
                       lower_.begin() + static_cast<std::ptrdiff_t>(end));
        for (std::size_t p = begin; p < end; ++p) lower_[p] = product(lower_[p], diagonals_[k]);
        for (std::size_t p = begin; p < end; ++p) {
            for (std::size_t q = begin; q < p; ++q)
                subtract(lower_[targets_[next++]], lower_[p], scaled_[q - begin]);
            subtract(diagonals_[static_cast<std::size_t>(rows_[p])], lower_[p], scaled_[p - begin]);
        }
    }
    return true;
}

void BlockLdl::solve(std::vector<double>& x)
{
    const std::size_t count = diagonals_.size();
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t c = 0; c < 3; ++c) work_[3 * k + c] = x[3 * static_cast<std::size_t>(order_[k]) + c];
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t p = starts_[k]; p < starts_[k + 1]; ++p)
            subtract(&work_[3 * static_cast<std::size_t>(rows_[p])], lower_[p], &work_[3 * k]);
    for (std::size_t k = count; k-- > 0;) {
        double z[3] = {};
        subtract(z, diagonals_[k], &work_[3 * k]);
        for (double& value : z) value = -value;
        for (std::size_t p = starts_[k]; p < starts_[k + 1]; ++p)
            subtractTransposed(z, lower_[p], &work_[3 * static_cast<std::size_t>(rows_[p])]);
        for (std::size_t c = 0; c < 3; ++c) work_[3 * k + c] = z[c];
    }
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t c = 0; c < 3; ++c) x[3 * static_cast<std::size_t>(order_[k]) + c] = work_[3 * k + c];
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
