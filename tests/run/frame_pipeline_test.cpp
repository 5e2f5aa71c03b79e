#include "run/passes/frame_pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace clusterbench::run {
namespace {

struct Numbered {
  int number = 0, square = 0;
};

// Each user's frames, in the order in which it got them.
struct Log {
  std::vector<std::vector<int>> squares;
  std::atomic<int> alive = 0, most_alive = 0;
};

FrameWork<Numbered> squares_into(Log& log, std::size_t users) {
  log.squares.resize(users);
  FrameWork<Numbered> work;
  work.begin = [](int index) { return std::make_unique<Numbered>(Numbered{index, 0}); };
  work.prepare = [](Numbered& frame) { frame.square = frame.number * frame.number; };
  work.bytes = [](const Numbered&) { return std::size_t{1}; };
  for (std::size_t user = 0; user < users; ++user)
    work.users.push_back({[&log, user](const Numbered& frame) { log.squares[user].push_back(frame.square); }});
  return work;
}

void pause_ms(int duration_ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(duration_ms));
}

class Pipelines : public ::testing::TestWithParam<int> {
 protected:
  bool run(const FrameWork<Numbered>& work, int frames) {
    return FramePipeline<Numbered>(work, frames, GetParam(), stop).run();
  }
  // The text of what it throws.
  std::string failure(const FrameWork<Numbered>& work, int frames) {
    try {
      run(work, frames);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing";
  }

  std::atomic<bool> stop{false};
};

std::vector<int> first_squares(int count) {
  std::vector<int> squares;
  for (int i = 0; i < count; ++i) squares.push_back(i * i);
  return squares;
}

TEST_P(Pipelines, give_each_user_all_prepared_frames_in_order) {
  for (const bool apart : {true, false})
    for (const int frames : {0, 1, 2, 7, 100}) {
      Log log;
      FrameWork<Numbered> work = squares_into(log, 3);
      work.users_apart = apart;
      EXPECT_TRUE(run(work, frames));
      for (const std::vector<int>& squares : log.squares) EXPECT_EQ(squares, first_squares(frames));
    }
}

TEST_P(Pipelines, call_what_comes_after_a_frame_when_all_users_have_it_and_none_has_the_next) {
  Log log;
  FrameWork<Numbered> work = squares_into(log, 3);
  std::size_t seen = 0;
  work.after = [&](const Numbered& frame) {
    ++seen;
    EXPECT_EQ(static_cast<std::size_t>(frame.number) + 1, seen);
    for (const std::vector<int>& squares : log.squares) EXPECT_EQ(squares.size(), seen);
  };
  EXPECT_TRUE(run(work, 20));
  EXPECT_EQ(seen, 20u);
}

TEST_P(Pipelines, throw_the_first_failure_by_frame_and_then_by_user) {
  Log log;
  FrameWork<Numbered> work = squares_into(log, 3);
  const auto fail_at = [](int wanted, const std::string& name) {
    return [=](const Numbered& frame) {
      if (frame.number < wanted) return;
      pause_ms(wanted - 16);  // a later failure comes after those before it
      throw std::runtime_error(name + " " + std::to_string(frame.number));
    };
  };
  work.users[0].use = fail_at(18, "first user");
  work.users[1].use = fail_at(17, "second user");
  work.users[2].use = fail_at(17, "third user");
  EXPECT_EQ(failure(work, 60), "second user 17");
  work.prepare = fail_at(18, "preparation");
  EXPECT_EQ(failure(work, 60), "second user 17");
  work.prepare = fail_at(16, "preparation");
  EXPECT_EQ(failure(work, 60), "preparation 16");
  const auto begin = work.begin;
  work.begin = [&](int index) {
    if (index == 15) throw std::runtime_error("beginning 15");
    return begin(index);
  };
  EXPECT_EQ(failure(work, 60), "beginning 15");
}

// What a leader leaves has two places: it must not overwrite one that is still read, nor be read before it writes.
TEST_P(Pipelines, let_users_behind_a_leader_use_what_it_left_two_frames_long) {
  for (const bool has_after : {false, true}) {
    Log log;
    FrameWork<Numbered> work = squares_into(log, 1);
    std::array<int, 2> left{-1, -1};  // not guarded: beside one another they are a race
    work.users[0].use = [&](const Numbered& frame) { left[static_cast<std::size_t>(frame.number) % 2] = frame.square; };
    std::array<int, 3> differing{};
    for (std::size_t i = 0; i < differing.size(); ++i)
      work.users.push_back({[&, i](const Numbered& frame) {
                              if (i == 0 && frame.number % 100 == 0) pause_ms(1);  // the leader could go on
                              differing[i] += left[static_cast<std::size_t>(frame.number) % 2] != frame.square;
                            },
                            0});
    if (has_after) work.after = [](const Numbered&) {};
    EXPECT_TRUE(run(work, 2000));
    EXPECT_EQ(differing, (std::array<int, 3>{}));
  }
}

// It must not overwrite what users behind it still read either, however many of its frames are in work.
TEST_P(Pipelines, let_a_concurrent_leader_work_on_several_frames_and_users_behind_it_have_all_in_order) {
  constexpr int k_places = 3, k_frames = 2000;
  Log log;
  FrameWork<Numbered> work = squares_into(log, 0);
  std::array<int, k_places> left{};  // not guarded
  std::atomic<int> begun = 0, at_once = 0, most_at_once = 0;
  const auto leave = [&](const Numbered& frame) {
    most_at_once = std::max(most_at_once.load(), ++at_once);
    ++begun;
    // Another thread can begin the next frame while this one is in work.
    for (int i = 0; frame.number == 1 && GetParam() > 1 && begun < 3 && i < 10000; ++i) pause_ms(1);
    left[static_cast<std::size_t>(frame.number % k_places)] = frame.square;
    --at_once;
  };
  work.users.push_back({leave, FrameUser<Numbered>::k_none, k_places, true});
  std::vector<int> read;
  int differing = 0;
  work.users.push_back(
      {[&](const Numbered& frame) { read.push_back(left[static_cast<std::size_t>(frame.number % k_places)]); }, 0});
  work.users.push_back({[&](const Numbered& frame) {
                          if (frame.number % 100 == 0) pause_ms(1);
                          differing += left[static_cast<std::size_t>(frame.number % k_places)] != frame.square;
                        },
                        0});
  EXPECT_TRUE(run(work, k_frames));
  EXPECT_EQ(begun, k_frames);
  EXPECT_EQ(read, first_squares(k_frames));
  EXPECT_EQ(differing, 0);
  EXPECT_EQ(most_at_once > 1, GetParam() > 1);
  EXPECT_LE(most_at_once, k_places);
}

TEST_P(Pipelines, throw_the_first_failure_of_a_concurrent_leader) {
  Log log;
  FrameWork<Numbered> work = squares_into(log, 0);
  work.users.push_back({[](const Numbered& frame) {
                          if (frame.number < 20) return;
                          pause_ms(frame.number == 20 ? 20 : 0);
                          throw std::runtime_error("leader " + std::to_string(frame.number));
                        },
                        FrameUser<Numbered>::k_none, 8, true});
  int last = -1;
  work.users.push_back({[&](const Numbered& frame) { last = frame.number; }, 0});
  EXPECT_EQ(failure(work, 60), "leader 20");
  EXPECT_EQ(last, 19);
}

TEST_P(Pipelines, end_with_a_stop_without_another_frame) {
  Log log;
  FrameWork<Numbered> work = squares_into(log, 2);
  work.users.push_back({[&](const Numbered& frame) { stop = frame.number == 9; }});
  EXPECT_FALSE(run(work, 1000));
  for (const std::vector<int>& squares : log.squares) EXPECT_LT(squares.size(), 10u + 8u * 4u);
}

TEST_P(Pipelines, keep_one_frame_ahead_if_frames_are_large) {
  struct Counted {
    explicit Counted(Log& of) : log(of) { log.most_alive = std::max(log.most_alive.load(), ++log.alive); }
    ~Counted() { --log.alive; }
    Log& log;
  };
  Log log;
  FrameWork<Counted> work;
  work.begin = [&](int) { return std::make_unique<Counted>(log); };
  work.prepare = [](Counted&) {};
  work.bytes = [](const Counted&) { return k_most_bytes_ahead; };
  work.users.push_back({[](const Counted&) {}});
  EXPECT_TRUE(FramePipeline<Counted>(work, 40, GetParam(), stop).run());
  EXPECT_LE(log.most_alive, 2);
}

INSTANTIATE_TEST_SUITE_P(Threads, Pipelines, ::testing::Values(1, 2, 8));

}  // namespace
}  // namespace clusterbench::run
