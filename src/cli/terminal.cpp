#include "cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "core/text.h"

namespace clusterbench::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds k_redraw_every{100};
constexpr std::chrono::seconds k_tell_every{10};  // where no line can be redrawn

std::string minutes_and_seconds(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  char text[32];
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

}  // namespace

// One digit, or two of them: more would not be true.
Terminal terminal(int stream) {
  Terminal found;
  const char* term = std::getenv("TERM");
  const bool dumb = term == nullptr || std::string_view(term) == "dumb";
  const char* no_color = std::getenv("NO_COLOR");
  found.interactive = isatty(stream) != 0 && !dumb;
  found.colour = found.interactive && (no_color == nullptr || *no_color == '\0');
  winsize size{};
  if (ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) found.columns = size.ws_col;
  return found;
}

void ProgressLine::show(const run::Progress& progress) {
  if (quiet_) return;
  const auto now = Clock::now();
  if (!terminal_.interactive && now - told_at_ < k_tell_every) return;
  if (drawn_ && now - drawn_at_ < k_redraw_every) return;
  drawn_at_ = told_at_ = now;
  const double share = progress.cost_total > 0 ? progress.cost_done / progress.cost_total : 0.0;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  std::string line = "[" + std::to_string(progress.cases_done) + "/" + std::to_string(progress.cases_total) + "] ";
  line += std::to_string(static_cast<int>(100.0 * share)) + " %";
  if (share > 0.01) line += ", " + minutes_and_seconds(elapsed_s * (1.0 - share) / share) + " left";
  line += "  " + printable(progress.doing);
  if (!terminal_.interactive) {
    std::cerr << line << std::endl;
    return;
  }
  if (line.size() >= static_cast<std::size_t>(terminal_.columns))
    line.resize(static_cast<std::size_t>(terminal_.columns) - 1);
  std::cerr << "\r\033[K" << line << std::flush;
  drawn_ = true;
}

void ProgressLine::stage(const std::string& what) {
  if (!quiet_ && !terminal_.interactive) std::cerr << printable(what) << std::endl;
}

void ProgressLine::case_done(const run::CaseResult& done, std::size_t number, std::size_t total) {
  if (quiet_ || terminal_.interactive) return;
  told_at_ = Clock::now();
  std::cerr << "[" << number << "/" << total << "] " << printable(done.name);
  if (done.error) {
    char excess[32];
    std::snprintf(excess, sizeof excess, "%.1f", 100.0 * done.error->excess_ratio());
    std::cerr << ": excess " << excess << " %, missed " << done.error->false_negatives;
  }
  if (done.timing) {
    char micros[32];
    std::snprintf(micros, sizeof micros, "%.1f", done.timing->frame_ns.median / 1000.0);
    std::cerr << ", " << micros << " us";
  }
  if (done.count)
    std::cerr << ", " << done.count->assign.instructions / static_cast<std::uint64_t>(done.count->frames)
              << " instructions";
  std::cerr << std::endl;
}

void ProgressLine::clear() {
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

}  // namespace clusterbench::cli
