#include "report/history.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/error.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int k_history_version = 1;

Json history_line(const Json& result, const std::string& commit) {
  Json line{{"history_version", k_history_version},
            {"commit", commit},
            {"name", result.at("name")},
            {"cpu", result.at("machine").at("cpu")},
            {"simd_target", result.at("tool").at("simd_target")},
            {"cases", Json::array()}};
  for (const Json& one : result["cases"]) {
    Json figures = Json::object();
    for (const Measured& figure : measured(one, false)) figures[std::string(figure.metric->name)] = figure.value;
    line["cases"].push_back({{"id", one.at("id")}, {"name", one.at("name")}, {"figures", figures}});
  }
  return line;
}

HistoryEntry::Case parsed_case(const Json& one) {
  HistoryEntry::Case out{one.at("name").get<std::string>(), {}};
  for (const auto& [name, value] : one.at("figures").items()) out.figures.emplace_back(name, value.get<double>());
  return out;
}

HistoryEntry parsed(const std::string& line) {
  const Json json = Json::parse(line);
  if (json.at("history_version") != k_history_version)
    throw Error("", "", "history_version is " + json["history_version"].dump() + "; this version reads 1");
  HistoryEntry entry{json.at("commit").get<std::string>(),
                     json.at("cpu").get<std::string>() + ", " + json.at("simd_target").get<std::string>(),
                     {}};
  for (const Json& one : json.at("cases")) entry.cases.push_back(parsed_case(one));
  return entry;
}

HistoryEntry parsed_at(const std::string& path, const std::string& line, std::size_t number) {
  const std::string where = "line " + std::to_string(number);
  try {
    return parsed(line);
  } catch (const nlohmann::json::parse_error&) {
    throw Error(path, where, "is not JSON");
  } catch (const nlohmann::json::exception&) {
    throw Error(path, where, "is not a line of `clusterbench history add`");
  } catch (const Error& error) {
    throw Error(path, where, error.message());
  }
}

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) throw Error(path, "", "cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<HistoryEntry> parsed_file(const std::string& path, const std::string& text) {
  std::vector<HistoryEntry> history;
  for (std::size_t begin = 0, number = 1; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos)
      throw Error(path, "line " + std::to_string(number), "has no end; was its writing interrupted?");
    history.push_back(parsed_at(path, text.substr(begin, end - begin), number));
    begin = end + 1;
  }
  return history;
}

// All bytes on the disk before the file takes its name.
void replace_file(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0)
    throw Error(fresh, "",
                errno == EEXIST ? "exists: another `history add` is at work, or one was interrupted; then remove it"
                                : std::string("cannot be written: ") + std::strerror(errno));
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t now = ::write(file, text.data() + written, text.size() - written);
    if (now <= 0) break;
    written += static_cast<std::size_t>(now);
  }
  const bool is_whole = written == text.size() && ::fsync(file) == 0;
  if (::close(file) == 0 && is_whole && std::rename(fresh.c_str(), path.c_str()) == 0) return;
  const std::string why = std::strerror(errno);
  ::unlink(fresh.c_str());
  throw Error(path, "", "could not be replaced: " + why, ExitCode::internal);
}

const Metric* metric_named(const std::string& name) {
  for (const Metric& metric : export_metrics())
    if (metric.name == name) return &metric;
  return nullptr;
}

std::string series_text(const Series& series, bool has_machine) {
  std::string text = series.case_name + "  " + std::string(series.metric->name) + " (" +
                     std::string(series.metric->unit) + ")" + (has_machine ? "  on " + series.machine : "") + "\n  " +
                     std::to_string(series.values.size()) + " values, " + figure_text(series.values.front()) + " to " +
                     figure_text(series.values.back()) + "\n";
  for (const measure::ChangePoint& change : series.changes) {
    char p[48];
    std::snprintf(p, sizeof p, change.p < 1e-9 ? "p < 1e-9" : "p %.1g", change.p);
    const std::string way = direction(*series.metric, change);
    text += "  at " + series.commits[change.index] + ": " + figure_text(change.before) + " to " +
            figure_text(change.after) + ", " + change_text(change) + (way.empty() ? "" : ", " + way) + " (" + p + ")\n";
  }
  return text;
}

}  // namespace

std::vector<HistoryEntry> read_history(const std::string& path) {
  return parsed_file(path, file_text(path));
}

void add_to_history(const std::string& path, const Json& result, const std::string& commit) {
  std::string text = fs::exists(path) ? file_text(path) : "";
  parsed_file(path, text);
  text += history_line(result, commit).dump() + "\n";
  replace_file(path, text);
}

std::vector<Series> series_of(const std::vector<HistoryEntry>& history, const measure::ChangeRule& rule) {
  std::vector<Series> all;
  std::map<std::pair<std::string, std::string>, std::map<const Metric*, std::size_t>> places;
  for (const HistoryEntry& entry : history)
    for (const HistoryEntry::Case& one : entry.cases)
      for (const auto& [name, value] : one.figures) {
        const Metric* metric = metric_named(name);
        if (metric == nullptr) continue;  // of an older version
        const auto [place, is_new] = places[{one.name, entry.machine}].try_emplace(metric, all.size());
        if (is_new) all.push_back({one.name, entry.machine, metric, {}, {}, {}});
        all[place->second].commits.push_back(entry.commit);
        all[place->second].values.push_back(value);
      }
  for (Series& series : all) series.changes = measure::change_points(series.values, rule);
  return all;
}

std::string direction(const Metric& metric, const measure::ChangePoint& change) {
  if (metric.better == Better::neither) return "";
  return (change.after < change.before) == (metric.better == Better::smaller) ? "better" : "worse";
}

std::string change_text(const measure::ChangePoint& change) {
  if (change.before == 0.0) return "from 0";
  char text[48];
  std::snprintf(text, sizeof text, "%+.3g %%", 100.0 * (change.after / change.before - 1.0));
  return text;
}

std::string history_text(const std::vector<Series>& series, std::size_t entries, bool all) {
  const bool has_machines =
      std::any_of(series.begin(), series.end(), [&](const Series& one) { return one.machine != series[0].machine; });
  std::string text;
  std::size_t changes = 0;
  for (const Series& one : series) {
    changes += one.changes.size();
    if (all || !one.changes.empty()) text += series_text(one, has_machines);
  }
  return text + std::to_string(entries) + " results, " + std::to_string(series.size()) + " series, " +
         std::to_string(changes) + (changes == 1 ? " change\n" : " changes\n");
}

std::string figure_text(double value) {
  char text[48];
  std::snprintf(text, sizeof text, std::abs(value) < 1e5 ? "%.5g" : "%.0f", value);
  return text;
}

}  // namespace clusterbench::report
