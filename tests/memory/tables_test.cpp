// SPDX-License-Identifier: MIT
// What the tables of a world hold, by its own account and by that of the source they take it from.
#include "support/build.hpp"
#include "support/scenes.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <memory_resource>

namespace tamias2d {
namespace {

using namespace test;

// Counts what is held of it.
class Counting : public std::pmr::memory_resource {
public:
    std::size_t held = 0, most = 0;

private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override
    {
        held += bytes;
        most = std::max(most, held);
        return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    }
    void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override
    {
        held -= bytes;
        std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
    }
    bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override
    {
        return this == &other;
    }
};

TableMemory tableOf(const World& world, std::string_view name)
{
    for (const TableMemory& table : world.memory().tables)
        if (table.name == name) return table;
    ADD_FAILURE() << "no table of " << name;
    return {};
}

void addTiles(World& world, int side)
{
    for (int i = 0; i < side * side; ++i)
        addBox(world, {1.0 * (i % side), 1.0 * (i / side)}, 1, 1, {.type = BodyType::Static});
}

TEST(Memory, IsGivenBackToTheSourceThatItCameFrom)
{
    TRACES("NFR1");
    Counting source;
    {
        World world({.memory = &source});
        addTiles(world, 20);
        Body box = addBox(world, {5, 30}, 1, 1);
        box.setName("a name that is longer than any short string");
        box.shapes().front().setMaterial({.friction = toReal(0.1)});
        for (int i = 0; i < 30; ++i) world.step();
        for (const BodyId id : world.bodies())
            if (id.index % 3 == 0) world.destroyBody(id);
        addTiles(world, 10);
        world.step();

        // Its own account of what lasts, but for joints, is that of the source.
        std::size_t told = 0;
        for (const char* name : {"bodies", "bodies that may move", "extras of bodies", "shapes",
                                 "forms of shapes", "surfaces of shapes", "shapes at rest, in trees"})
            told += tableOf(world, name).bytes;
        EXPECT_EQ(told, source.held);
        EXPECT_GT(source.held, 400 * (sizeof(Position) + 8));
        for (const std::string& fault : world.validate()) ADD_FAILURE() << fault;
    }
    EXPECT_EQ(source.held, 0u);
}

TEST(Memory, FromAnySourceGivesTheSameBits)
{
    TRACES("NFR1", "ADR6");
    const auto run = [](std::pmr::memory_resource* memory) {
        World world({.memory = memory});
        addGround(world);
        for (int i = 0; i < 20; ++i) addBox(world, {0.3 * (i % 3), 0.6 + 1.1 * i}, 1, 1);
        for (int i = 0; i < 120; ++i) world.step();
        return world.stateHash();
    };
    std::pmr::monotonic_buffer_resource arena;
    EXPECT_EQ(run(&arena), run(nullptr));
}

TEST(Memory, OfATileIsAtMostTwoHundredBytesWithItsPlaceInTheTrees)
{
    TRACES("NFR1");
    constexpr int kSide = 256;
    World world;
    const std::size_t before = world.memory().bytes();
    addTiles(world, kSide);
    world.step();
    const double each = static_cast<double>(world.memory().bytes() - before) / (kSide * kSide);
    record("bytesOfATile", each);
    EXPECT_LE(each, kDouble ? 260 : 200);
    EXPECT_EQ(tableOf(world, "forms of shapes").rows, 1u);
}

TEST(Memory, KeepsHighWaterMarksOfWhatComesAndGoes)
{
    TRACES("NFR1");
    World world;
    addGround(world);
    std::vector<Body> boxes;
    for (int i = 0; i < 10; ++i) {
        boxes.push_back(addBox(world, {2.0 * i, 0.501}, 1, 1));
        boxes.back().setUserData(7);
    }
    for (int i = 0; i < 10; ++i) world.step();
    EXPECT_EQ(tableOf(world, "contacts").rows, 10u);
    EXPECT_EQ(tableOf(world, "bodies in a step").rows, 11u);
    for (int i = 0; i < 6; ++i) boxes[static_cast<std::size_t>(i)].destroy();
    world.step();
    for (const auto& [name, rows, most] : {std::tuple{"bodies", 5u, 11u},
                                           {"bodies that may move", 5u, 11u},  // and the ground they met
                                           {"extras of bodies", 4u, 10u},
                                           {"shapes", 5u, 11u},
                                           {"contacts", 4u, 10u},
                                           {"bodies in a step", 5u, 11u}}) {
        const TableMemory table = tableOf(world, name);
        EXPECT_EQ(table.rows, rows) << name;
        EXPECT_EQ(table.most, most) << name;
        EXPECT_GE(table.capacity, table.most) << name;
        EXPECT_GT(table.bytes, 0u) << name;
    }
    // All fall asleep.
    for (int i = 0; i < 90; ++i) world.step();
    ASSERT_EQ(world.lastReport().asleep, 4u);
    EXPECT_EQ(tableOf(world, "contacts asleep").rows, 4u);
    boxes.back().wake();
    EXPECT_EQ(tableOf(world, "contacts asleep").rows, 3u);
    EXPECT_EQ(tableOf(world, "contacts asleep").most, 4u);
}

}  // namespace
}  // namespace tamias2d
