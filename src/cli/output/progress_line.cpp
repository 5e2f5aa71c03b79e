#include "cli/output/progress_line.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "core/text.h"

namespace clusterbench::cli {
namespace {

constexpr std::chrono::milliseconds k_redraw_every{100};

std::string minutes_and_seconds(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  char text[32];
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

}  // namespace

ProgressLine::ProgressLine(os::Terminal terminal, bool quiet, std::chrono::milliseconds print_every)
    : terminal_(terminal), quiet_(quiet), print_every_(print_every) {
  if (quiet_ || terminal_.interactive) return;
  try {
    printer_ = std::thread([this] { print_when_silent(); });
  } catch (const std::system_error&) {
    // The system allows no more threads: the line is printed as work is done, never between.
  }
}

ProgressLine::~ProgressLine() {
  clear();
  if (!printer_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  printer_.join();
}

std::string ProgressLine::line() const {
  const double share = last_.cost_total > 0 ? last_.cost_done / last_.cost_total : 0.0;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  std::string out;
  if (last_.cases_total > 0)  // pictures have none
    out = "[" + std::to_string(last_.cases_done) + "/" + std::to_string(last_.cases_total) + "] ";
  out += std::to_string(static_cast<int>(100.0 * share)) + " %";
  if (share > 0.01) out += ", " + minutes_and_seconds(elapsed_s * (1.0 - share) / share) + " left";
  return out + "  " + printable(last_.doing);
}

// A single write, since two threads print.
void ProgressLine::print_line(const std::string& line) {
  std::cerr << line + "\n" << std::flush;
  printed_at_ = Clock::now();
}

// A step may take longer than a reader of a log wants to wait for an update.
void ProgressLine::print_when_silent() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_until(lock, printed_at_ + print_every_, [this] { return has_ended_; })) {
    if (Clock::now() - printed_at_ < print_every_) continue;
    if (has_last_)
      print_line(line());
    else
      printed_at_ = Clock::now();
  }
}

void ProgressLine::show(const run::Progress& progress) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  last_ = progress;
  has_last_ = true;
  if (!terminal_.interactive) return;
  const auto now = Clock::now();
  if (drawn_ && now - drawn_at_ < k_redraw_every) return;
  drawn_at_ = now;
  std::string text = line();
  if (text.size() >= static_cast<std::size_t>(terminal_.columns))
    text.resize(static_cast<std::size_t>(terminal_.columns) - 1);
  std::cerr << "\r\033[K" << text << std::flush;
  drawn_ = true;
}

void ProgressLine::stage(const std::string& name) {
  if (quiet_ || terminal_.interactive) return;
  const std::scoped_lock lock(mutex_);
  print_line(printable(name));
}

void ProgressLine::case_done(const run::CaseResult& done, std::size_t number, std::size_t total) {
  if (quiet_ || terminal_.interactive) return;
  std::string out = "[" + std::to_string(number) + "/" + std::to_string(total) + "] " + printable(done.name);
  char figure[32];
  if (done.error) {
    std::snprintf(figure, sizeof figure, "%.1f", 100.0 * done.error->excess_ratio());
    out += std::string(": excess ") + figure + " %, missed " + std::to_string(done.error->false_negatives);
  }
  if (done.timing) {
    std::snprintf(figure, sizeof figure, "%.1f", done.timing->frame_ns.median / 1000.0);
    out += std::string(", ") + figure + " us";
  }
  if (done.count)
    out += ", " + std::to_string(done.count->assign.instructions / static_cast<std::uint64_t>(done.count->frames)) +
           " instructions";
  const std::scoped_lock lock(mutex_);
  print_line(out);
}

void ProgressLine::clear() {
  const std::scoped_lock lock(mutex_);
  has_last_ = false;
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

}  // namespace clusterbench::cli
