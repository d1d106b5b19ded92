#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace defocus::engine {
namespace {

TEST(Tasks, allAreDoneOnceWhoeverDoesThem) {
    for (const std::size_t workers : {0u, 1u, 3u}) {
        std::vector<int> done(100, 0);
        Tasks tasks(workers);
        for (int& count : done) tasks.add([&count] { ++count; });
        tasks.wait();
        EXPECT_EQ(done, std::vector<int>(100, 1)) << workers;
        tasks.add([&] { ++done[0]; });
        tasks.wait();
        EXPECT_EQ(done[0], 2) << workers;
    }
}

TEST(Tasks, anExceptionReachesTheOneWhoWaits) {
    for (const std::size_t workers : {0u, 2u}) {
        std::atomic<int> done = 0;
        Tasks tasks(workers);
        EXPECT_THROW(
            {
                tasks.add([] { throw std::runtime_error("task"); });
                tasks.add([&] { ++done; });
                tasks.wait();
            },
            std::runtime_error)
            << workers;
        EXPECT_EQ(done, workers > 0 ? 1 : 0) << "the other tasks still run";
    }
}

// Tasks that nobody waits for are dropped, which destroys the last copy of their data. The only worker waits until the
// data are destroyed, but at most a minute, so that a bug fails the test instead of blocking it.
TEST(Tasks, whatNobodyWaitsForIsDropped) {
    if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core: the thread that adds work does it";
    std::atomic<int> done = 0;
    auto held = std::make_shared<int>(0);
    {
        std::latch started(1);
        Tasks tasks(1);
        tasks.add([&started, others = std::weak_ptr<int>(held)] {
            started.count_down();
            const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
            while (!others.expired() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
        });
        started.wait();
        for (int i = 0; i < 1000; ++i) tasks.add([&done, held] { ++done; });
        held.reset();
    }
    EXPECT_EQ(done, 0);
}

TEST(ParallelFor, everyIndexOnceAndTheFirstExceptionComesBack) {
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
        std::vector<std::atomic<int>> times(count);
        parallelFor(count, [&](std::size_t i) { ++times[i]; });
        for (const std::atomic<int>& each : times) EXPECT_EQ(each, 1);
    }
    EXPECT_THROW(parallelFor(100,
                             [](std::size_t i) {
                                 if (i == 50) throw std::runtime_error("body");
                             }),
                 std::runtime_error);
}

}  // namespace
}  // namespace defocus::engine
