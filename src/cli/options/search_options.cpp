#include "cli/options/search_options.h"

#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "geom/shapes/domain.h"

namespace clusterbench::cli {
namespace {

// All of the text as a number; NaN if it is none.
double number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? std::nan("") : value;
}

// "4x10": four lights with a range of 10 m; "10": one.
void add_lights(const std::string& text, std::vector<double>& ranges_m) {
  constexpr double k_most = 64;
  const std::size_t cross = text.find('x');
  const double count = cross == std::string::npos ? 1.0 : number_in(text.substr(0, cross));
  const double range_m = number_in(cross == std::string::npos ? text : text.substr(cross + 1));
  if (!(count >= 1.0 && count <= k_most) || count != std::floor(count) ||
      !(range_m > 0.0 && range_m <= geom::k_farthest_m))
    throw Error("", "--add-lights",
                "'" + text + "' is not COUNTxRANGE, as in 4x10: 1 to 64 lights, and metres above 0 and up to 1e15");
  ranges_m.insert(ranges_m.end(), static_cast<std::size_t>(count), range_m);
  if (static_cast<double>(ranges_m.size()) > k_most) throw Error("", "--add-lights", "adds more than 64 lights");
}

std::optional<search::Box> box_in(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(number_in(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (numbers.size() != 6 || std::ranges::any_of(numbers, [](double number) { return !std::isfinite(number); }))
    throw Error("", "--within", "'" + text + "' is no box: takes six numbers in metres, X0,Y0,Z0,X1,Y1,Z1");
  return search::Box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

}  // namespace

void add_effort_options(Command& command, SearchFlags& flags, const Option* only_with) {
  std::vector<Option> options{
      command.add_option("--evaluations", flags.request.evaluations, "Frames that the search may measure")
          .range(1, 10'000'000)
          .shows_standard(),
      command
          .add_option("--seconds", flags.request.seconds,
                      "End the search after so many, too; the result then depends on the machine; 0 = never")
          .non_negative()
          .shows_standard(),
      command.add_option("--seed", flags.request.seed, "Seed of everything random").seed()};
  if (only_with != nullptr)
    for (Option& option : options) option.needs(*only_with);
}

void add_space_options(Command& command, SearchFlags& flags, const Option* only_with) {
  std::vector<Option> options{
      command.add_option("--within", flags.within,
                         "X0,Y0,Z0,X1,Y1,Z1: where the camera may stand, metres; without: the box of the scene's "
                         "lights and recorded eyes"),
      command.add_flag("--walkable", flags.request.walkable,
                       "The camera stands above triangles of the scene that look upward (at most 45 degrees from it)"),
      command.add_option("--eye-height", flags.request.eye_height_m, "With --walkable: so high above them, metres")
          .range(0.0, 1e6)
          .shows_standard(),
      command.add_flag("--keep-height", flags.request.keep_height,
                       "The camera stands as high as recorded, from the lowest to the highest"),
      command.add_flag("--keep-direction", flags.request.keep_direction,
                       "The camera looks as in one of the recorded frames, as over a strategy game; without: anywhere, "
                       "upright"),
      command
          .add_option("--add-lights", flags.added,
                      "COUNTxRANGE, repeatable: so many point lights of that range, in metres, stand where they are "
                      "worst")
          .once_a_name(),
      command
          .add_option("--move-lights", flags.request.move_m,
                      "Move each light of the scene by up to so many metres; 0: none")
          .range(0.0, 1e15)
          .shows_standard()};
  if (only_with != nullptr)
    for (Option& option : options) option.needs(*only_with);
}

search::WorstCaseRequest search_request(const SearchFlags& flags, const config::Config& config) {
  search::WorstCaseRequest request = flags.request;
  for (const std::string& text : flags.added) add_lights(text, request.extra_ranges_m);
  request.within = box_in(flags.within);
  request.threads = config.threads;
  return request;
}

search::WorstCaseListener search_listener(ProgressLine& progress, std::size_t search, std::size_t searches) {
  search::WorstCaseListener listener;
  listener.on_progress = [&progress, search, searches](const std::string& doing, int done, int whole) {
    // Progress counts frames for a single search, and searches for several.
    const double frames_done = static_cast<double>(whole) * static_cast<double>(search) + done;
    run::Progress now{search, searches, frames_done, static_cast<double>(whole) * static_cast<double>(searches), doing};
    if (searches == 1)
      now.cases_done = static_cast<std::size_t>(done), now.cases_total = static_cast<std::size_t>(whole);
    progress.show(now);
  };
  return listener;
}

}  // namespace clusterbench::cli
