#include "dump/list_keys.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/json_document.h"
#include "dump/dump_template.h"
#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

result::DumpLists lists_from(const char* json) {
  return result::from_json<result::DumpLists>(result::Json::parse(json));
}

std::string key_refusal(const char* json) {
  try {
    check_list_keys(lists_from(json), "/lists/0");
    return "";
  } catch (const Error& error) {
    return error.where() + ": " + error.message();
  }
}

TEST(ListKeys, that_a_layout_does_not_read_are_refused_with_the_layouts_that_do) {
  const std::pair<const char*, const char*> rows[] = {
      {R"({"layout": "packed", "per_cell": 4})",
       "/lists/0/per_cell: has no meaning with layout 'packed'; it is of fixed"},
      {R"({"layout": "packed", "first_bit": 4})",
       "/lists/0/first_bit: has no meaning with layout 'packed'; it is of bits, bits_and_bins, bits_and_slice_ranges"},
      {R"({"layout": "packed", "word": "u32"})", "/lists/0/word: has no meaning with layout 'packed'; it is of bits, "},
      {R"({"layout": "packed", "head": {"at": 0, "type": "u32"}})",
       "/lists/0/head: has no meaning with layout 'packed'; it is of linked"},
      {R"({"layout": "packed", "entries": {"buffer": "i", "type": "u16", "end": 7}})",
       "/lists/0/entries/end: has no meaning with layout 'packed'; it is of fixed"},
      {R"({"layout": "packed", "ranges": {"buffer": "b", "stride": 8, "first": {"at": 0, "type": "u32"},
           "last": {"at": 4, "type": "u32"}}})",
       "/lists/0/ranges: has no meaning with layout 'packed'; it is of bits_and_bins, bits_and_slice_ranges"},
      {R"({"layout": "bits_and_bins", "ranges": {"buffer": "b", "stride": 8, "tile_stride": 8,
           "first": {"at": 0, "type": "u32"}, "last": {"at": 4, "type": "u32"}}})",
       "/lists/0/ranges/tile_stride: has no meaning with layout 'bits_and_bins'; it is of bits_and_slice_ranges"},
      {R"({"layout": "bits_and_bins", "per_tile": true})",
       "/lists/0/per_tile: has no meaning with layout 'bits_and_bins'; it is of packed, fixed"},
      {R"({"layout": "inline", "entries": {"type": "u16", "first_light": 1}})",
       "/lists/0/entries: has no meaning with layout 'inline'; it is of packed, fixed, runs"},
      {R"({"layout": "inline", "rows": {"buffer": "b", "stride": 4}})",
       "/lists/0/rows: has no meaning with layout 'inline'; it is of packed"},
      {R"({"layout": "linked", "cells": [[]]})",
       "/lists/0/cells: has no meaning with layout 'linked'; it is of inline"},
      {R"({"layout": "fixed", "per_cell": 4, "rows": {"buffer": "b", "stride": 4},
           "entries": {"buffer": "i", "type": "u16", "end": 0}})",
       "/lists/0/rows: has no meaning where entries have a buffer of their own"}};
  for (const auto& [json, wanted] : rows)
    EXPECT_EQ(key_refusal(json).substr(0, std::string(wanted).size()), wanted) << json;
}

TEST(ListKeys, of_our_own_dumps_and_of_all_templates_are_read) {
  const Made made = made_frame({{0, 0}, {4, 3}, 0.0});
  for (const char* storage : {"packed", "fixed", "bitfield", "linked", "runs"})
    EXPECT_NO_THROW(check_list_keys(described(made.truth, made.frame.ranges(), storage).lists, "/lists/0")) << storage;
  for (const DumpTemplate& row : dump_templates()) {
    const auto json = read_json<result::Json>(row.text, std::string(row.name), JsonComments::allowed);
    for (const result::DumpLists& lists : result::from_json<result::Dump>(json).lists)
      EXPECT_NO_THROW(check_list_keys(lists, "/lists/0")) << row.name;
  }
}

TEST(ListKeys, are_checked_where_a_dump_is_read) {
  const Made made = made_frame({{0, 0}, {4, 3}, 0.0});
  DumpFile dump = dump_of(made, made.truth);
  dump.record.lists[0].per_cell = 9;
  try {
    parse_dump(result::to_json(dump.record).dump(), "made.json");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/lists/0/per_cell");
  }
}

}  // namespace
}  // namespace clusterbench::dump
