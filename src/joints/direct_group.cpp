// SPDX-License-Identifier: MIT
#include "joints/direct_group.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

void DirectGroup::build(const std::vector<JointRows>& all, const Table<Motion>& motions)
{
    rows.clear();
    const auto addRowsOf = [&](const JointRows& tie) {
        tie.eachRow([&](std::uint32_t row) {
            if (motions[row].moves()) rows.push_back(row);
        });
    };
    const auto sortOut = [&] {
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    };
    for (const std::uint32_t j : joints) addRowsOf(all[j]);
    sortOut();
    const std::size_t tied = rows.size();
    for (const JointRows& contact : contacts) addRowsOf(contact);
    if (!contacts.empty()) sortOut();
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
    const bool held = std::any_of(nodes.begin(), nodes.end(),
                                  [](const BlockLdl::Edge& of) { return of.first < 0 || of.second < 0; });
    loops = tied > 0 && joints.size() + (held ? 0 : 1) > tied;
    for (const JointRows& contact : contacts) addNodesOf(contact);
    const int count = static_cast<int>(rows.size());
    if (count == analyzedNodes && edges == analyzed) return;
    matrix.analyze(count, edges);
    analyzedNodes = count;
    analyzed.swap(edges);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
