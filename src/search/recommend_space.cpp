#include "search/recommend_space.h"

#include "assign/contract/assigner.h"
#include "assign/contract/storage.h"

namespace clusterbench::search {
namespace {

using Json = nlohmann::json;

Json grids() {
  // Few slices, or none but the tiles' own, are best if surfaces are about as far as the lights.
  const Json few_slices{{"scheme", "exponential"}, {"count", 4}};
  const Json even_slices{{"scheme", "linear"}, {"count", {1, 4, 16}}};
  const Json depth_slices{{"scheme", {"exponential", "exponential-first", "power", "fit"}}, {"count", {8, 16, 24, 32}}};
  const Json shells{{"scheme", {"exponential", "exponential-first"}}, {"count", {16, 24}}};
  Json all = Json::array();
  for (const Json& slices : {depth_slices, few_slices, even_slices}) {
    all.push_back({{"kind", "frustum"}, {"tiles", {{"pixels", {32, 64, 128, 256}}}}, {"slices", slices}});
    all.push_back({{"kind", "frustum"}, {"tiles", {{"count", {{16, 8}}}}}, {"slices", slices}});
  }
  const Json others =
      Json::array({{{"kind", "distance"}, {"tiles", {{"pixels", {{64, 64}, {128, 128}}}}}, {"slices", shells}},
                   {{"kind", "cascades"}, {"finest", {0.5, 1.0, 2.0}}},
                   {{"kind", "world"}, {"cells", {{32, 8, 32}, {64, 16, 64}}}}});
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

bool is_wanted(const assign::AssignerDescriptor& method) {
  return method.is_default() && !method.all_pairs && assign::is_conservative(method, assign::Params(method.params)) &&
         assign::find_assigner(method.name + "-fast") == nullptr;
}

}  // namespace

Json recommend_space() {
  Json assigners = Json::array(), storages = Json::array();
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (is_wanted(*method)) assigners.push_back(method->name);
  for (const assign::StorageDescriptor* storage : assign::storage_descriptors()) storages.push_back(storage->name);
  return {{"grids", grids()}, {"assigners", assigners}, {"storages", storages}};
}

}  // namespace clusterbench::search
