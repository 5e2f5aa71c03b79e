// Google Benchmark's JSON (https://github.com/google/benchmark, docs/user_guide.md): each timed round is a repetition,
// so that compare.py can do its Mann-Whitney U test. One thread works, so its processor time equals the elapsed time.

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "report/exports/export_formats.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view k_time = "frame_time";  // the figure of the samples

double mean(const std::vector<double>& samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

double standard_deviation(const std::vector<double>& samples) {
  if (samples.size() < 2) return 0.0;
  const double middle = mean(samples);
  double squares = 0.0;
  for (const double sample : samples) squares += (sample - middle) * (sample - middle);
  return std::sqrt(squares / static_cast<double>(samples.size() - 1));
}

Json entry(const ExportCase& export_case, std::size_t family, const std::string& name, const char* run_type) {
  return {{"name", name},
          {"family_index", family},
          {"per_family_instance_index", 0},
          {"run_name", export_case.name},
          {"run_type", run_type},
          {"repetitions", export_case.samples_ns.size()}};
}

void add_time(Json& entry, double time_ns, int iterations) {
  entry["threads"] = 1;
  entry["iterations"] = iterations;
  entry["real_time"] = time_ns;
  entry["cpu_time"] = time_ns;
  entry["time_unit"] = "ns";
}

Json repetition(const ExportCase& export_case, std::size_t family, std::size_t index) {
  Json out = entry(export_case, family, export_case.name, "iteration");
  out["repetition_index"] = index;
  add_time(out, export_case.samples_ns[index], export_case.frames_timed);
  for (const Measured& figure : export_case.figures)
    if (figure.figure->exported_as() != k_time) out[std::string(figure.figure->exported_as())] = figure.value;
  return out;
}

Json aggregate(const ExportCase& export_case, std::size_t family, const std::string& name, double time_ns) {
  Json out = entry(export_case, family, export_case.name + "_" + name, "aggregate");
  out["aggregate_name"] = name;
  out["aggregate_unit"] = "time";
  add_time(out, time_ns, static_cast<int>(export_case.samples_ns.size()));
  return out;
}

}  // namespace

std::string google_benchmark(const ExportResult& result) {
  Json out{{"context",
            {{"host_name", result.machine},
             {"executable", "clusterbench " + result.version + " (" + result.git_sha + ")"},
             {"num_cpus", result.cores},
             {"library_build_type", result.build_type == "Debug" ? "debug" : "release"}}},
           {"benchmarks", Json::array()}};
  Json& all = out["benchmarks"];
  for (std::size_t family = 0; family < result.cases.size(); ++family) {
    const ExportCase& export_case = result.cases[family];
    const Measured* median = find_figure(export_case, k_time);
    if (export_case.samples_ns.empty() || median == nullptr) continue;
    for (std::size_t index = 0; index < export_case.samples_ns.size(); ++index)
      all.push_back(repetition(export_case, family, index));
    all.push_back(aggregate(export_case, family, "mean", mean(export_case.samples_ns)));
    all.push_back(aggregate(export_case, family, "median", median->value));
    all.push_back(aggregate(export_case, family, "stddev", standard_deviation(export_case.samples_ns)));
  }
  if (all.empty()) throw Error("", "google-benchmark", "takes times, and no case has one: run it without --no-timing");
  return out.dump(1) + "\n";
}

}  // namespace clusterbench::report
