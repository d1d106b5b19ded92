#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace defocus {
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
        EXPECT_EQ(done, workers > 0 ? 1 : 0) << "the others are done all the same";
    }
}

TEST(Tasks, whatNobodyWaitsForIsDropped) {
    std::atomic<int> done = 0;
    {
        Tasks tasks(1);
        for (int i = 0; i < 1000; ++i) tasks.add([&] { ++done; });
    }
    EXPECT_LE(done, 1000);  // and it ended
}

}  // namespace
}  // namespace defocus
