#pragma once
// Frames that several threads prepare and use, without waiting for one another where they need not.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/stop.h"
#include "core/work_in_order.h"
#include "run/passes/frame_work.h"

namespace clusterbench::run {

// Each thread takes the next part of the work that can be done: a user with its next frame, else the preparation of
// another frame.
template <class Frame>
class FrameLanes {
 public:
  // At most `most_alive` frames, at least 1, are in memory.
  FrameLanes(const FrameWork<Frame>& work, int frames, std::size_t most_alive, const Stop& stop)
      : work_(work), frames_(frames), most_alive_(most_alive), stop_(stop), users_(work.users.size()) {}

  // The first frame, prepared.
  void add(std::unique_ptr<Frame> first) {
    alive_.push_back(begun_frame(std::move(first)));
    alive_.back().is_prepared = true;
  }

  // False if stopped before the end. Throws what one thread would throw: the first failure by frame, then by user.
  bool run(ThreadPool& pool) {
    each_in_order(pool, static_cast<std::size_t>(pool.threads()), [this](std::size_t) { take_part(); });
    if (failure_) std::rethrow_exception(failure_);
    return !stop_;
  }

 private:
  using Lock = std::unique_lock<std::mutex>;
  using Part = std::pair<int, std::size_t>;  // a frame; 0: its preparation, 1 + user

  struct Alive {
    std::unique_ptr<Frame> frame;
    bool is_prepared = false;
    std::vector<bool> is_used;  // by user
    std::size_t users_left = 0;
  };
  struct User {
    int next = 0;     // its next frame
    int working = 0;  // threads at its frames
  };

  void take_part() {
    Lock lock(mutex_);
    while (!stop_) {
      if (use_next(lock) || prepare_next(lock)) continue;
      if (working_ == 0) break;
      constexpr std::chrono::milliseconds k_look_for_stop{50};
      changed_.wait_for(lock, k_look_for_stop);
    }
    changed_.notify_all();
  }

  Alive begun_frame(std::unique_ptr<Frame> frame) const {
    return {std::move(frame), false, std::vector<bool>(users_.size()), users_.size()};
  }
  Alive& alive(int frame) { return alive_[static_cast<std::size_t>(frame - first_alive_)]; }
  int end_of_alive() const { return first_alive_ + static_cast<int>(alive_.size()); }
  // One thread would not get there.
  bool is_after_failure(const Part& part) const { return failure_ && failed_ <= part; }

  bool can_go_on(std::size_t user) {
    const User& one = users_[user];
    return (one.working == 0 || work_.users[user].is_concurrent) && one.next < end_of_alive() &&
           alive(one.next).is_prepared && !is_after_failure({one.next, user + 1}) && is_led(user) && is_followed(user);
  }
  bool is_led(std::size_t user) {
    const std::size_t leader = work_.users[user].leader;
    return leader == FrameUser<Frame>::k_none || alive(users_[user].next).is_used[leader];
  }
  // Whether all users behind this one are near enough.
  bool is_followed(std::size_t user) const {
    for (std::size_t other = user + 1; other < users_.size(); ++other)
      if (work_.users[other].leader == user &&
          users_[user].next - frames_done_by(other) >= work_.users[user].most_ahead)
        return false;
    return true;
  }
  // By a user that is not concurrent.
  int frames_done_by(std::size_t user) const { return users_[user].next - users_[user].working; }

  // The following return false if there is nothing of the kind to do now.
  bool use_next(Lock& lock) {
    std::size_t last = users_.size();  // the user that is most behind
    for (std::size_t user = 0; user < users_.size(); ++user)
      if (can_go_on(user) && (last == users_.size() || users_[user].next < users_[last].next)) last = user;
    if (last == users_.size()) return false;
    const int number = users_[last].next++;
    const Frame& frame = *alive(number).frame;
    ++users_[last].working;
    do_part(lock, {number, last + 1}, [&] { work_.users[last].use(frame); });
    --users_[last].working;
    alive(number).is_used[last] = true;
    --alive(number).users_left;
    drop_used();
    return true;
  }

  bool prepare_next(Lock& lock) {
    const int number = end_of_alive();
    const Part part{number, 0};
    if (number >= frames_ || alive_.size() >= most_alive_ || is_after_failure(part)) return false;
    std::unique_ptr<Frame> begun = this->begun(part);
    if (!begun) return true;
    alive_.push_back(begun_frame(std::move(begun)));
    Frame& frame = *alive_.back().frame;
    do_part(lock, part, [&] { work_.prepare(frame); });
    alive(number).is_prepared = true;
    return true;
  }
  std::unique_ptr<Frame> begun(const Part& part) {
    try {
      return work_.begin(part.first);
    } catch (...) {
      fail(part);
      return nullptr;
    }
  }

  template <class Work>
  void do_part(Lock& lock, const Part& part, const Work& work) {
    ++working_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    --working_;
    if (failure) fail(part, failure);
    changed_.notify_all();
  }
  void fail(const Part& part, std::exception_ptr failure = std::current_exception()) {
    if (is_after_failure(part)) return;
    failed_ = part;
    failure_ = std::move(failure);
  }

  void drop_used() {
    for (; !alive_.empty() && alive_.front().users_left == 0; ++first_alive_) alive_.pop_front();
  }

  const FrameWork<Frame>& work_;
  int frames_;
  std::size_t most_alive_;
  Stop stop_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<User> users_;
  std::deque<Alive> alive_;  // from first_alive_ on
  int first_alive_ = 0;
  int working_ = 0;  // threads at a part
  Part failed_{};    // of the failure
  std::exception_ptr failure_;
};

}  // namespace clusterbench::run
