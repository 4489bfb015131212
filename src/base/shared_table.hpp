// SPDX-License-Identifier: MIT
#pragma once

#include "base/memory.hpp"

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Rows that many may share: each different one is here once, with the number of its users, and is found by
/// the hash of its bits. Numbers are given out again, so they say nothing about order, and no result may
/// depend on them.
///
/// A key has `hash()`, `matches(row)` and `make()`, which gives the row.
template <class Row>
class SharedTable {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    explicit SharedTable(MemorySource memory = nullptr)
        : rows_(sourceOr(memory)), links_(sourceOr(memory)), heads_(sourceOr(memory)), free_(sourceOr(memory))
    {
    }

    /// The number of the row that matches the key, which has one more user from now on.
    template <class Key>
    std::uint32_t take(const Key& key)
    {
        // Who makes many of a kind makes them one after the other.
        if (const Row* row = last(); row != nullptr && key.matches(*row)) {
            ++links_[last_].users;
            return last_;
        }
        const std::uint64_t hash = key.hash();
        if (!heads_.empty()) {
            for (std::uint32_t i = heads_[place(hash)]; i != kNone; i = links_[i].next) {
                if (links_[i].hash != hash || !key.matches(rows_[i])) continue;
                ++links_[i].users;
                return last_ = i;
            }
        }
        return last_ = add(key.make(), hash);
    }

    /// One user less; the last one takes the row along, and sets the number to none.
    void giveBack(std::uint32_t& number)
    {
        if (number == kNone) return;
        if (--links_[number].users == 0) {
            std::uint32_t* link = &heads_[place(links_[number].hash)];
            while (*link != number) link = &links_[*link].next;
            *link = links_[number].next;
            free_.push_back(number);
        }
        number = kNone;
    }

    /// The row taken last, if it is still in use.
    const Row* last() const
    {
        return last_ < rows_.size() && links_[last_].users > 0 ? &rows_[last_] : nullptr;
    }
    const Row& operator[](std::uint32_t number) const { return rows_[number]; }
    std::size_t size() const { return rows_.size() - free_.size(); }   ///< that are in use
    std::size_t slots() const { return rows_.size(); }                 ///< that were ever in use at once
    std::size_t capacity() const { return rows_.capacity(); }
    std::size_t bytes() const { return bytesOf(rows_) + bytesOf(links_) + bytesOf(heads_) + bytesOf(free_); }
    std::uint32_t users(std::uint32_t number) const { return links_[number].users; }

    Row& spoil(std::uint32_t number) { return rows_[number]; }   ///< for tests: all users see it

private:
    struct Link {
        std::uint64_t hash;
        std::uint32_t next;   // of those with the same head
        std::uint32_t users;
    };
    Column<Row> rows_;
    Column<Link> links_;            // by row
    Column<std::uint32_t> heads_;   // by hash, a power of two of them
    Column<std::uint32_t> free_;
    std::uint32_t last_ = kNone;         // taken

    std::size_t place(std::uint64_t hash) const { return hash & (heads_.size() - 1); }

    std::uint32_t add(Row row, std::uint64_t hash)
    {
        std::uint32_t number;
        if (free_.empty()) {
            number = static_cast<std::uint32_t>(rows_.size());
            rows_.push_back(row);
            links_.emplace_back();
            if (rows_.size() > heads_.size()) spread();
        } else {
            number = free_.back();
            free_.pop_back();
            rows_[number] = row;
        }
        std::uint32_t& head = heads_[place(hash)];
        links_[number] = {hash, head, 1};
        head = number;
        return number;
    }

    // Twice as many heads. The newest row has no hash yet.
    void spread()
    {
        heads_.assign(heads_.empty() ? 16 : 2 * heads_.size(), kNone);
        for (std::uint32_t i = 0; i + 1 < rows_.size(); ++i) {
            if (links_[i].users == 0) continue;
            std::uint32_t& head = heads_[place(links_[i].hash)];
            links_[i].next = head;
            head = i;
        }
    }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
