// SPDX-License-Identifier: MIT
// The sparse factorization against products of its own matrix, and against the fill of known patterns.
#include "joints/block_ldl.hpp"
#include "support/random.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tamias2d {
namespace {

using namespace test;
using Edge = BlockLdl::Edge;

// A symmetric, diagonally dominant matrix with blocks on the edges, as rows of numbers.
struct Dense {
    std::size_t size;
    std::vector<double> a;
    double& at(std::size_t r, std::size_t c) { return a[r * size + c]; }

    Dense(int nodes, const std::vector<Edge>& edges)
        : size(3 * static_cast<std::size_t>(nodes)), a(size * size)
    {
        Random random(3);
        const auto fill = [&](std::size_t n, std::size_t m) {
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t c = 0; c < 3; ++c)
                    at(3 * n + r, 3 * m + c) = at(3 * m + c, 3 * n + r) = random.between(-1, 1);
        };
        for (std::size_t n = 0; n < static_cast<std::size_t>(nodes); ++n) fill(n, n);
        for (const auto& [n, m] : edges) fill(static_cast<std::size_t>(n), static_cast<std::size_t>(m));
        for (std::size_t i = 0; i < size; ++i) at(i, i) = 3.0 * static_cast<double>(size);
    }
};

void load(BlockLdl& matrix, Dense& dense, int nodes, const std::vector<Edge>& edges)
{
    matrix.clear();
    const auto block = [&](BlockLdl::Block& out, int row, int column) {
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c)
                out.a[3 * r + c] =
                    dense.at(3 * static_cast<std::size_t>(row) + r, 3 * static_cast<std::size_t>(column) + c);
    };
    for (int n = 0; n < nodes; ++n) block(matrix.diagonal(n), n, n);
    for (const auto& [n, m] : edges) {
        const auto [out, transposed] = matrix.between(n, m);
        transposed ? block(*out, m, n) : block(*out, n, m);
    }
}

std::vector<Edge> chainOf(int nodes)
{
    std::vector<Edge> edges;
    for (int i = 1; i < nodes; ++i) edges.emplace_back(i - 1, i);
    return edges;
}

TEST(BlockLdl, SolvesWhatItWasGiven)
{
    TRACES("LC3", "NFR2");
    std::vector<Edge> loop = chainOf(9), grid;
    loop.emplace_back(8, 0);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) {
            if (x > 0) grid.emplace_back(3 * y + x - 1, 3 * y + x);
            if (y > 0) grid.emplace_back(3 * y + x, 3 * (y - 1) + x);
        }
    for (const std::vector<Edge>& edges : {chainOf(9), loop, grid, std::vector<Edge>{}}) {
        Dense dense(9, edges);
        BlockLdl matrix;
        matrix.analyze(9, edges);
        load(matrix, dense, 9, edges);
        ASSERT_TRUE(matrix.factor());
        std::vector<double> x(27), b(27, 0);
        Random random(11);
        for (double& value : x) value = random.between(-1, 1);
        for (std::size_t r = 0; r < 27; ++r)
            for (std::size_t c = 0; c < 27; ++c) b[r] += dense.at(r, c) * x[c];
        matrix.solve(b);
        for (std::size_t i = 0; i < 27; ++i)
            EXPECT_NEAR(b[i], x[i], 1e-12) << edges.size() << " edges, " << i;
    }
}

TEST(BlockLdl, ATreeFillsNothingIn)
{
    TRACES("LC3", "NFR3");
    std::vector<Edge> star, chain = chainOf(200);
    for (int i = 1; i < 200; ++i) star.emplace_back(0, i);
    for (const std::vector<Edge>& edges : {star, chain}) {
        BlockLdl matrix;
        matrix.analyze(200, edges);
        EXPECT_EQ(matrix.fill(), 199u);
    }
}

TEST(BlockLdl, SaysWhereAMatrixIsNotPositive)
{
    TRACES("R4");
    BlockLdl matrix;
    matrix.analyze(2, {{0, 1}});
    matrix.clear();
    for (const int n : {0, 1})
        for (int i = 0; i < 3; ++i) matrix.diagonal(n).a[4 * i] = n == 0 ? 1 : -1;
    EXPECT_FALSE(matrix.factor());
}

}  // namespace
}  // namespace tamias2d
