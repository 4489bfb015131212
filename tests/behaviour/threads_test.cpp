// SPDX-License-Identifier: MIT
// How many threads work, and who does what when, changes no result.
#include <support/build.hpp>
#include <support/random.hpp>
#include <support/scenes.hpp>
#include <support/traces.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <numeric>
#include <thread>

namespace tamias2d::test {
namespace {

// --- scenes, large enough that their loops are shared out

void pileUp(World& world)
{
    addBin(world, {});
    addHail(world, 400, true, 3, {.restitution = 0.3});
}

// So many boxes that each color of their contacts is shared out; they overlap a little.
void wall(World& world)
{
    addGround(world, 0, 600);
    for (int row = 0; row < 8; ++row)
        for (int i = 0; i < 500; ++i) addBox(world, {i - 250 + 0.5 * (row % 2), 0.49 + 0.98 * row}, 0.99, 1);
}

// A wide stack; it falls asleep, and a ball wakes it.
void hitSleepers(World& world)
{
    addGround(world);
    for (int row = 0; row < 10; ++row)
        for (int i = 0; i < 40; ++i) addBox(world, {1.5 * (i - 20), 0.501 + 1.001 * row}, 1, 1);
    addDisc(world, {-45, 3.2}, 0.5, {.velocity = vec(60, 0), .restitution = 0.5});
}

void mix(World& world)
{
    addBin(world, {});
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const Position at{(i % 8 - 3.5) * 1.2 + random.between(-0.1, 0.1), 1 + (i / 8) * 1.1};
        const Options options{.velocity = vec(random.between(-3, 3), random.between(-20, 0)),
                              .spin = random.between(-9, 9),
                              .angle = random.between(0, 3),
                              .rounding = i % 8 == 0 ? 0.05 : 0,
                              .rollingResistance = i % 5 == 0 ? 0.02 : 0};
        switch (i % 4) {
        case 0:
            addBox(world, at, 0.6, 0.4, options);
            break;
        case 1:
            addDisc(world, at, 0.3, options);
            break;
        case 2:
            addCapsule(world, at, 0.8, 0.2, options);
            break;
        default:
            addRegular(world, at, 3 + i % 6, 0.35, options);
            break;
        }
    }
}

// Elastic impacts and nothing else.
void gas(World& world)
{
    world.setGravity({});
    const Options elastic{.friction = 0, .restitution = 1};
    addWalls(world, {-12, -12}, {12, 12}, elastic);
    Random random(7);
    for (int i = 0; i < 400; ++i) {
        Options options = elastic;
        options.velocity = vec(random.between(-9, 9), random.between(-9, 9));
        addDisc(world, {(i % 20 - 9.5) * 1.15, (i / 20 - 9.5) * 1.15}, 0.3, options);
    }
}

// Chains over a pile.
void chains(World& world)
{
    pileUp(world);
    for (int k = 0; k < 6; ++k) {
        Body last = addDisc(world, {1.5 * k - 4, 8}, 0.05, {.type = BodyType::Static});
        for (int i = 0; i < 8; ++i) {
            const Position at{1.5 * k - 4 + 0.4 * i, 8};
            Body link = addBox(world, {at.x + 0.2, at.y}, 0.36, 0.1);
            world.createJoint(revoluteAt(last, link, at));
            last = link;
        }
    }
}

struct SceneCase {
    const char* name;
    void (*fill)(World&);
    int steps;
};
void PrintTo(const SceneCase& c, std::ostream* out)
{
    *out << c.name;
}

std::uint64_t hashAfter(const SceneCase& scene, const WorldDef& def)
{
    World world(def);
    scene.fill(world);
    for (int i = 0; i < scene.steps; ++i) world.step();
    return world.stateHash();
}

class Threads : public testing::TestWithParam<SceneCase> {};

TEST_P(Threads, GiveTheSameBitsHoweverManyTheyAre)
{
    TRACES("ADR6", "ADR26");
    const std::uint64_t alone = hashAfter(GetParam(), {});
    for (const int threads : {2, 3, 8})
        EXPECT_EQ(hashAfter(GetParam(), {.threads = threads}), alone) << threads << " threads";
}

// Does the parts one after the other, in another order each time.
class Shuffling final : public TaskSystem {
public:
    int threads() const noexcept override { return 16; }
    void run(Task& task, int parts) override
    {
        ++runs;
        order_.resize(static_cast<std::size_t>(parts));
        std::iota(order_.begin(), order_.end(), 0);
        if (runs % 2 == 0) std::reverse(order_.begin(), order_.end());
        for (std::size_t i = order_.size(); runs % 2 != 0 && i > 1; --i)
            std::swap(order_[i - 1], order_[static_cast<std::size_t>(random_.between(0, double(i)))]);
        for (const int part : order_) task.run(part);
    }
    long runs = 0;

private:
    std::vector<int> order_;
    Random random_{11};
};

TEST_P(Threads, GiveTheSameBitsInWhateverOrderAHostDoesTheParts)
{
    TRACES("ADR6", "ADR26");
    Shuffling host;
    EXPECT_EQ(hashAfter(GetParam(), {.tasks = &host}), hashAfter(GetParam(), {}));
    EXPECT_GT(host.runs, GetParam().steps);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Threads,
                         testing::Values(SceneCase{"pile", pileUp, 60}, SceneCase{"wall", wall, 12},
                                         SceneCase{"sleepers", hitSleepers, 90}, SceneCase{"mix", mix, 60},
                                         SceneCase{"gas", gas, 30}, SceneCase{"chains", chains, 40}));

TEST(ThreadsOfAWorld, AreOneToSixtyFour)
{
    TRACES("R4", "ADR26");
    for (const int threads : {0, -1, 65, 1 << 30}) {
        try {
            World world({.threads = threads});
            ADD_FAILURE() << threads << " threads were taken";
        } catch (const InputError& error) {
            EXPECT_EQ(error.field, "WorldDef.threads");
            EXPECT_EQ(error.value, std::to_string(threads));
            EXPECT_EQ(error.rule, "must be in [1, 64]");
        }
        World world;
        EXPECT_THROW(world.setThreads(threads), InputError);
        EXPECT_EQ(world.definition().threads, 1);
    }
    World world({.threads = kMaxThreads});
    EXPECT_EQ(world.definition().threads, kMaxThreads);
    world.step();
}

TEST(ThreadsOfAWorld, MayChangeBetweenSteps)
{
    TRACES("ADR6", "ADR26");
    World alone, changing;
    pileUp(alone);
    pileUp(changing);
    Shuffling host;
    for (int i = 0; i < 60; ++i) {
        if (i % 10 == 0) changing.setThreads(1 + (i / 10) % 3);
        if (i % 20 == 15) changing.setThreads(1, &host);
        if (i % 20 == 19) changing.setThreads(2, nullptr);
        alone.step();
        changing.step();
        ASSERT_EQ(changing.stateHash(), alone.stateHash()) << "after step " << i;
    }
    EXPECT_GT(host.runs, 0);
}

TEST(ThreadsOfAWorld, LetItBeMadeSteppedAndDestroyedByDifferentThreads)
{
    TRACES("ADR26");
    const std::uint64_t expected = hashAfter({"pile", pileUp, 20}, {});
    std::unique_ptr<World> world;
    std::thread([&] {
        world = std::make_unique<World>(WorldDef{.threads = 3});
        pileUp(*world);
    }).join();
    for (int i = 0; i < 20; ++i) std::thread([&] { world->step(); }).join();
    EXPECT_EQ(world->stateHash(), expected);
    std::thread([&] { world.reset(); }).join();
}

TEST(ThreadsOfAWorld, EndWithItUsedOrNot)
{
    TRACES("ADR26");
    for (int i = 0; i < 30; ++i) {
        World idle({.threads = 4});
        World used({.threads = 3});
        pileUp(used);
        used.step();
    }
}

TEST(ThreadsOfAWorld, AreItsOwnWhileOthersStep)
{
    TRACES("ADR6", "ADR26");
    const SceneCase scene{"pile", pileUp, 30};
    const std::uint64_t expected = hashAfter(scene, {});
    std::vector<std::future<std::uint64_t>> hashes;
    for (int i = 0; i < 3; ++i)
        hashes.push_back(std::async(std::launch::async, [&] { return hashAfter(scene, {.threads = 2}); }));
    for (auto& hash : hashes) EXPECT_EQ(hash.get(), expected);
}

// One host, several worlds that step at the same time.
class Spawning final : public TaskSystem {
public:
    int threads() const noexcept override { return 2; }
    void run(Task& task, int parts) override
    {
        std::thread other([&] {
            for (int i = 0; i < parts; i += 2) task.run(i);
        });
        for (int i = 1; i < parts; i += 2) task.run(i);
        other.join();
    }
};

TEST(ThreadsOfAWorld, MayBeThoseOfAHostThatServesSeveral)
{
    TRACES("ADR6", "ADR26");
    const SceneCase scene{"pile", pileUp, 10};
    const std::uint64_t expected = hashAfter(scene, {});
    Spawning host;
    auto first = std::async(std::launch::async, [&] { return hashAfter(scene, {.tasks = &host}); });
    EXPECT_EQ(hashAfter(scene, {.tasks = &host}), expected);
    EXPECT_EQ(first.get(), expected);
}

TEST(ThreadsOfAWorld, ShowInItsProfile)
{
    TRACES("NFR1", "ADR26");
    Spawning host;
    World world({.tasks = &host});
    pileUp(world);
    world.setProfiling(true);
    for (int i = 0; i < 3; ++i) world.step();
    double end = 0;
    int others = 0;
    for (const ProfileSpan& span : world.profile()) {
        if (span.thread == 0) continue;
        ++others;
        EXPECT_EQ(span.depth, 0u);
        EXPECT_STRNE(span.name, "");
        EXPECT_LE(span.begin, span.end);
        if (span.thread == 1) {
            EXPECT_GE(span.begin, end);
            end = span.end;
        }
    }
    EXPECT_GT(others, 0);
}

}  // namespace
}  // namespace tamias2d::test
