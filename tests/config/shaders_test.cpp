// The key `shaders`, and the schema of what it names.

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "config/config.h"
#include "config/config_shaders.h"
#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "gpu/user_shaders/shader_method.h"
#include "places.h"

namespace clusterbench::config {
namespace {

class Shaders : public ::testing::Test {
 protected:
  void TearDown() override { gpu::remove_shader_methods(); }
};

// A configuration in a folder of the checkout, configs/.
Config config_beside(const std::string& rest, const std::vector<FlagValue>& flags = {}) {
  return parse_config(R"({"scenes": ["a.glb"])" + rest + "}", test::source_dir() + "/configs/c.json", flags);
}
std::vector<std::string> labels_of(const Config& config) {
  std::vector<std::string> labels;
  for (const MethodRequest& method : config.assigners) labels.push_back(method.label());
  return labels;
}
std::string shader_refusal_of(const std::string& rest) {
  try {
    config_beside(rest);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(Shaders, run_beside_the_methods_that_are_named) {
  const Config config = config_beside(R"(, "assigners": ["aabb"], "shaders": ["shaders/append.json"])");
  EXPECT_EQ(labels_of(config), (std::vector<std::string>{"aabb", "append"}));
  EXPECT_EQ(config.resolved["shaders"][0], "shaders/append.json");
}

TEST_F(Shaders, run_once_with_the_parameters_that_are_named) {
  const Config config = config_beside(
      R"(, "assigners": [{"name": "append", "group": [8, 32]}, "aabb"], "shaders": ["shaders/append.json"])");
  EXPECT_EQ(labels_of(config), (std::vector<std::string>{"append(group=8)", "append", "aabb"}));
  EXPECT_NE(
      shader_refusal_of(R"(, "assigners": [{"name": "append", "group": 2000}], "shaders": ["shaders/append.json"])")
          .find("2000"),
      std::string::npos);
}

TEST_F(Shaders, of_flags_are_written_relative_to_the_configuration) {
  const std::string file = test::source_dir() + "/configs/shaders/append.json";
  const std::vector<FlagValue> flags{{"--shader", file}, {"--shader", file}, {"--assigner", "app*"}};
  const Config config = config_beside(R"(, "assigners": ["aabb"])", flags);
  EXPECT_EQ(config.resolved["shaders"], nlohmann::json::array({"shaders/append.json"}));
  EXPECT_EQ(labels_of(config), std::vector<std::string>{"append"});
  EXPECT_EQ(labels_of(changed(config, {{"threads", 2}})), std::vector<std::string>{"append"});
}

TEST_F(Shaders, are_refused_where_nothing_would_run_them_or_nothing_is_there) {
  EXPECT_NE(shader_refusal_of(R"(, "assigners": ["append"])").find("append"), std::string::npos);
  EXPECT_NE(shader_refusal_of(R"(, "presets": ["daveh355"], "shaders": ["shaders/append.json"])").find("runs nowhere"),
            std::string::npos);
  EXPECT_NE(
      shader_refusal_of(R"(, "shaders": ["shaders/none.json"])").find("configs/shaders/none.json: does not exist"),
      std::string::npos);
  EXPECT_NE(shader_refusal_of(R"(, "shaders": "shaders/append.json")").find("/shaders: found"), std::string::npos);
  EXPECT_NE(shader_refusal_of(R"(, "shaders": [1])").find("/shaders/0: found 1"), std::string::npos);
}

TEST_F(Shaders, of_the_examples_fulfil_their_schema_and_others_do_not) {
  const nlohmann::json schema = row_of(Document::shader).schema();
  for (const char* name : {"tutorial", "append", "counted"}) {
    const std::string file = test::source_dir() + "/configs/shaders/" + name + ".json";
    nlohmann::json example = read_json<nlohmann::json>(file_text(file), file);
    EXPECT_EQ(document_of(example), Document::shader);
    EXPECT_EQ(schema_violations(schema, example), std::vector<std::string>{}) << name;
    nlohmann::json wrong = example;
    wrong["lists"][0]["rows"]["stride"] = 1.5;
    EXPECT_FALSE(schema_violations(schema, wrong).empty()) << name;
    wrong = example;
    wrong["passes"][0]["grups"] = 1;
    EXPECT_FALSE(schema_violations(schema, wrong).empty()) << name;
  }
}

}  // namespace
}  // namespace clusterbench::config
