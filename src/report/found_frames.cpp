#include "report/found_frames.h"

#include <algorithm>

#include "config/documents.h"
#include "config/schema_verdict.h"
#include "core/error.h"
#include "core/file_text.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

Json read_worst_case(const std::string& path) {
  const Json json = Json::parse(file_text(path), nullptr, false);
  if (json.is_discarded()) throw Error(path, "", "is not JSON");
  const config::DocumentRow& row = config::row_of(config::Document::worst_case);
  if (config::document_of(json) != config::Document::worst_case)
    throw Error(path, "", "is not what `clusterbench worst-case -o FILE` writes");
  const std::vector<std::string> violations = config::schema_violations(row.schema(), nlohmann::json(json));
  if (!violations.empty())
    throw Error(path, "", "is not valid: " + violations.front() + "; `clusterbench validate` lists all");
  if (json["frames"].empty()) throw Error(path, "", "holds no frame: the search was ended before it tried any");
  return json;
}

void check_case(const std::string& path, const Json& searched, const Json& result) {
  const Json* match = nullptr;
  for (const Json& result_case : result["cases"])
    if (result_case["name"] == searched["name"]) match = &result_case;
  if (match == nullptr)
    throw Error(
        path, "/case/name",
        "is '" + searched["name"].get<std::string>() + "', and no case here has that name" +
            (result["cases"].empty() ? ""
                                     : "; one of them is '" + result["cases"][0]["name"].get<std::string>() + "'"));
  for (const Json& scene : result["scenes"])
    if (scene["name"] == (*match)["scene"] && scene["sha256"] != searched["sha256"])
      throw Error(path, "/case/sha256", "is of another version of the scene; search again");
}

}  // namespace

FoundFrame read_found(const std::string& path, const Json& result) {
  const Json json = read_worst_case(path);
  check_case(path, json["case"], result);
  FoundFrame out;
  out.case_name = json["case"]["name"].get<std::string>();
  out.measure = json["measure"]["name"].get<std::string>();
  out.value = static_cast<std::uint64_t>(std::max(0.0, json["frames"][0]["value"].get<double>()));
  out.evaluations = json["evaluations"].get<int>();
  out.seed = json["seed"].get<std::uint64_t>();
  out.eye_m = json["frames"][0]["eye_m"].get<std::vector<double>>();
  out.lights = json["space"]["lights"].get<std::uint64_t>() + json["space"]["added_ranges_m"].size();
  if (!json.contains("buffers"))
    throw Error(path, "/buffers", "is missing: an earlier version wrote the file, without what each buffer needs");
  for (std::size_t i = 0; i < json["buffers"].size(); ++i) {
    const Json& need = json["buffers"][i];
    if (!need.contains("element_bytes"))
      throw Error(path, "/buffers/" + std::to_string(i) + "/element_bytes",
                  "is missing: an earlier version wrote the file, and nothing says how wide the indices of its lights "
                  "are; search again");
    out.needs.push_back({need["name"].get<std::string>(), need["elements"].get<std::uint64_t>(),
                         need["theoretical_max"].get<std::uint64_t>(), need["element_bytes"].get<std::uint64_t>()});
  }
  return out;
}

Json search_json(const FoundFrame& found) {
  Json out{{"case", found.case_name}, {"measure", found.measure}};
  if (!found.refusal.empty())
    out["refusal"] = found.refusal;
  else
    out.update({{"evaluations", found.evaluations}, {"seed", found.seed}, {"eye_m", found.eye_m}});
  return out;
}

}  // namespace clusterbench::report
