#include "cli/options/picture_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "cli/output/output.h"
#include "core/error.h"
#include "core/libraries.h"
#include "core/text.h"
#include "geom/shapes/domain.h"
#include "os/output_file.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;
using pictures::k_kind_names;

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text)
    if (c == ',')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const pictures::KindName& row : k_kind_names) names.emplace_back(row.name);
  return names;
}

std::vector<pictures::Kind> kinds_of(const std::vector<std::string>& texts) {
  const std::vector<std::string> known = kind_names();
  std::vector<std::string> wanted;
  for (const std::string& text : texts)
    for (const std::string& word : words_of(text)) {
      if (std::find(known.begin(), known.end(), word) == known.end())
        throw Error(
            "", "--image-kinds",
            "'" + word + "' is no kind of picture" + did_you_mean(word, known) + "; there are " + joined(known));
      wanted.push_back(word);
    }
  std::vector<pictures::Kind> kinds;
  for (const pictures::KindName& row : k_kind_names)
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), row.name) != wanted.end()) kinds.push_back(row.kind);
  return kinds;
}

int frame_number(const std::string& word) {
  int number = -1;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (failed != std::errc() || end != word.data() + word.size() || number < 0)
    throw Error("", "--image-frames", "takes worst, first, or numbers of frames as in 0,10,59, not '" + word + "'");
  return number;
}

pictures::Request request_of(const ImageFlags& flags) {
  pictures::Request request;
  request.kinds = kinds_of(flags.kinds);
  request.divisor = flags.divisor;
  if (flags.plane_m > 0.0) request.plane_m = flags.plane_m;
  if (flags.scale > 0) request.top = static_cast<std::uint32_t>(std::min<std::uint64_t>(flags.scale, UINT32_MAX));
  if (flags.frames == "worst") return request;
  if (flags.frames == "first") {
    request.frames = pictures::Request::Frames::first;
    return request;
  }
  request.frames = pictures::Request::Frames::listed;
  for (const std::string& word : words_of(flags.frames)) request.listed.push_back(frame_number(word));
  std::sort(request.listed.begin(), request.listed.end());
  request.listed.erase(std::unique(request.listed.begin(), request.listed.end()), request.listed.end());
  return request;
}

void check_count(const run::Plan& plan, const pictures::Request& request) {
  const std::uint64_t count = pictures::picture_count(plan, request);
  if (count > pictures::k_most_pictures)
    throw Error("", "--images",
                std::to_string(count) + " pictures are more than " + std::to_string(pictures::k_most_pictures) +
                    ": choose cases (--filter), kinds (--image-kinds) or frames (--image-frames)");
}

// A method without cells has no longest list.
pictures::LongestLists longest_lists(const result::Result& result) {
  pictures::LongestLists longest;
  for (const result::Case& result_case : result.cases) {
    pictures::LongestList& list = longest[result_case.id];
    list.frame = static_cast<int>(result_case.buffers.worst_frame);
    if (!result_case.occupancy) continue;
    list = {static_cast<std::uint64_t>(result_case.occupancy->lights_per_cell.max),
            static_cast<int>(result_case.occupancy->worst_frame)};
  }
  return longest;
}

}  // namespace

void add_image_options(Command& command, ImageFlags& flags) {
  const Option images =
      command.add_option("--images", flags.folder, "DIR: pictures of each case as PNG files, in this folder");
  command
      .add_option("--image-frames", flags.frames,
                  "worst (the one with the longest list), first, or numbers of frames as in 0,10,59")
      .needs(images)
      .shows_standard();
  command.add_option("--image-kinds", flags.kinds, "KIND[,KIND]: only these of " + joined(kind_names()))
      .once_a_name()
      .needs(images);
  command
      .add_option("--image-divisor", flags.divisor,
                  "One pixel of each block of so many squared; without, as few as make no side longer than " +
                      std::to_string(pictures::k_longest_side))
      .range(1, 64)
      .needs(images);
  command
      .add_option("--image-depth", flags.plane_m, "METRES: all pixels at this depth, in place of the visible surfaces")
      .range(1e-15, geom::k_farthest_m)
      .needs(images);
  command.add_option("--image-scale", flags.scale, "N: the scale of lights ends there, in all pictures")
      .at_least(1)
      .needs(images);
}

PictureFiles::PictureFiles(const ImageFlags& flags, const config::Config& config, const run::Plan& plan,
                           std::vector<std::string> inputs)
    : config_(config), plan_(plan), folder_(flags.folder), inputs_(std::move(inputs)), request_(request_of(flags)) {
  need_library(Library::libpng, "--images", "pictures");
  check_count(plan, request_);
  made_.emplace(folder_);
  geometries_ = pictures::load_geometries(config, plan, request_);
  for (std::size_t i = 0; i < geometries_.size(); ++i)
    for (const std::string& warning : geometries_[i] ? geometries_[i]->warnings : std::vector<std::string>{})
      print_message("warning: " + plan.scenes[i].scene.name + ": " + warning);
}

std::string PictureFiles::index_path(const std::string& folder) {
  return (fs::path(folder) / "pictures.json").string();
}

void PictureFiles::write_picture(const fs::path& file, const std::string& bytes) const {
  const OutputFolder made(file.parent_path());
  refuse_overwriting({file.string()}, inputs_);
  os::write_file(file, bytes);
}

bool PictureFiles::write(const result::Result& result, os::Terminal screen, bool quiet,
                         const std::atomic<bool>& stop) const {
  ProgressLine progress(screen, quiet);
  std::uint64_t written = 0, skipped = 0;
  std::string first_skipped;
  pictures::Listener listener;
  nlohmann::ordered_json index{{"pictures", nlohmann::ordered_json::array()}};
  listener.on_picture = [&](const pictures::Picture& picture) {
    write_picture(fs::path(folder_) / picture.file, picture.png);
    index["pictures"].push_back({{"file", picture.file.generic_string()},
                                 {"kind", pictures::name_of(picture.kind)},
                                 {"frame", picture.frame ? nlohmann::ordered_json(*picture.frame) : nullptr},
                                 {"cases", picture.case_ids},
                                 {"text", picture.text}});
    ++written;
  };
  listener.on_progress = [&](const std::string& group, double share) {
    run::Progress now;
    now.cost_total = 1.0;
    now.cost_done = share;
    now.doing = group + ": pictures";
    progress.show(now);
  };
  listener.on_skipped = [&](const std::string& name, const std::string& reason) {
    if (skipped++ == 0) first_skipped = name + ": " + reason;
  };
  pictures::draw_pictures(config_, plan_, geometries_, request_, longest_lists(result), listener, stop);
  progress.clear();
  write_picture(fs::path(index_path(folder_)), index.dump(1) + "\n");
  if (skipped > 0) print_message("no pictures of " + number_of(skipped, "case") + "; the first is " + first_skipped);
  if (!quiet) print_message(number_of(written, "picture") + " in " + folder_);
  return !stop;
}

}  // namespace clusterbench::cli
