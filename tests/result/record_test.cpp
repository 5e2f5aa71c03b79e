// Records, their JSON and their schema.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "places.h"
#include "result/result.h"
#include "result/rounding.h"
#include "result/schema.h"

namespace clusterbench::result {
namespace {

struct Inner {
  RECORD(Inner);
  FIELD(std::uint64_t, lights, About("Lights", "lights", "a cell").at_least(1));
  FIELD_AS("true", std::string, truth, "What a keyword names");
  END_RECORD;
};

struct Outer {
  RECORD(Outer);
  FIELD(double, mean, "Mean", "m");
  FIELD(std::optional<double>, most, About("Most").finite().as_fraction());
  FIELD(Nullable<std::string>, take, "What to take");
  FIELD(std::vector<Inner>, inner, About("Parts").items(0, 3));
  FIELD(ByName<std::int64_t>, sets, About("By set").each("Of a set"));
  FIELD(std::optional<bool>, late, About("Later").late());
  FIELD(std::string, kind, About("Kind").one_of({"a", "b"}));
  FIELD(int, version, About("Version").always(2));
  END_RECORD;
};

struct Named : Inner {
  using Rest = Inner;
  RECORD(Named);
  FIELD(std::string, name, "Whose");
  FIELD(std::optional<double>, share, "Of it");
  END_RECORD;
};

Outer outer_by_hand() {
  Outer outer{.mean = 2.0,
              .most = 3.0,
              .take = {},
              .inner = {{7, "x"}},
              .sets = {{"fog", -1}},
              .late = {},
              .kind = "b",
              .version = 2};
  return outer;
}

constexpr const char* k_outer =
    R"({"mean":2,"most":3.0,"take":null,"inner":[{"lights":7,"true":"x"}],"sets":{"fog":-1},"kind":"b","version":2})";

TEST(Record, has_its_fields_in_their_order_and_leaves_out_what_is_absent) {
  EXPECT_EQ(to_json(outer_by_hand()).dump(), k_outer);
  Outer none = outer_by_hand();
  none.mean = k_none;
  none.take = "this";
  EXPECT_TRUE(to_json(none)["mean"].is_null());
  EXPECT_EQ(to_json(none)["take"], "this");
}

TEST(Record, read_back_is_what_was_written) {
  EXPECT_EQ(to_json(from_json<Outer>(Json::parse(k_outer))).dump(), k_outer);
}

TEST(Record, that_derives_from_another_has_its_fields_behind_its_own) {
  Named named{{7, "x"}};
  named.name = "n";
  constexpr const char* k_named = R"({"name":"n","lights":7,"true":"x"})";
  EXPECT_EQ(to_json(named).dump(), k_named);
  EXPECT_EQ(to_json(from_json<Named>(Json::parse(k_named))).dump(), k_named);
}

TEST(Record, names_the_place_of_what_it_cannot_read) {
  const auto refusal = [](const char* pointer, const Json& value) {
    Json json = Json::parse(k_outer);
    json[Json::json_pointer(pointer)] = value;
    try {
      result::from_json<Outer>(json, "/case");
    } catch (const Error& error) {
      return error.where() + " " + error.message();
    }
    return std::string("taken");
  };
  EXPECT_EQ(refusal("/mean", "2"), "/case/mean must be a number or null");
  EXPECT_EQ(refusal("/inner/0/lights", -1), "/case/inner/0/lights must be a whole number of at least 0");
  EXPECT_EQ(refusal("/inner", Json::object()), "/case/inner must be a list");
  EXPECT_EQ(refusal("/take", 1), "/case/take must be a text");
  EXPECT_TRUE(refusal("/kinds", 1).starts_with("/case/kinds is not known")) << refusal("/kinds", 1);
  EXPECT_NE(refusal("/kinds", 1).find("; allowed: "), std::string::npos) << refusal("/kinds", 1);
  EXPECT_EQ(refusal("/sets/sun", 1.5), "/case/sets/sun must be a whole number");
  EXPECT_EQ(refusal("/sets/sun", 9223372036854775808u),
            "/case/sets/sun must be a whole number from -9223372036854775808 to 9223372036854775807");
  Json less = Json::parse(k_outer);
  less["inner"][0].erase("true");
  EXPECT_THROW(from_json<Outer>(less), Error);
}

TEST(Record, its_schema_says_what_its_fields_say) {
  const Json schema = schema_of<Outer>("outer", "by hand"), &fields = schema["properties"];
  EXPECT_EQ(fields["mean"].dump(), R"({"description":"Mean","x-unit":"m","type":["number","null"]})");
  EXPECT_EQ(fields["most"]["type"], "number");
  EXPECT_EQ(fields["take"]["type"], Json({"string", "null"}));
  EXPECT_EQ(fields["inner"]["maxItems"], 3);
  EXPECT_EQ(fields["inner"]["items"]["properties"]["lights"].dump(),
            R"({"description":"Lights","x-unit":"lights","x-over":"a cell","type":"integer","minimum":1})");
  EXPECT_EQ(fields["inner"]["items"]["required"], Json({"lights", "true"}));
  EXPECT_EQ(fields["sets"]["additionalProperties"]["description"], "Of a set");
  EXPECT_EQ(fields["kind"]["enum"], Json({"a", "b"}));
  EXPECT_EQ(fields["version"]["const"], 2);
  EXPECT_EQ(schema["x-written"], Json({"late"}));
  EXPECT_EQ(schema["required"], Json({"mean", "take", "inner", "sets", "kind", "version"}));
}

TEST(Record, rounds_what_is_counted_to_nine_digits_and_what_is_measured_to_six) {
  EXPECT_EQ(counted(1.0 / 3.0), 0.333333333);
  EXPECT_EQ(counted(1234567890123.0), 1234567890123.0);
  EXPECT_EQ(measured(1234567.0 / 3.0), 411522.0);
}

// Whatever version wrote them: every field is known, and nothing is lost.
TEST(Record, of_each_committed_result_is_that_result) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_dir() + "/results")) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    const Json json = Json::parse(file);
    if (!json.contains("schema_version") || !json.contains("name")) continue;
    EXPECT_EQ(nlohmann::json(to_json(from_json<Result>(json))), nlohmann::json(json)) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 20);
}

}  // namespace
}  // namespace clusterbench::result
