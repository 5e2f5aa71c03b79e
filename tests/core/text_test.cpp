#include "core/text.h"

#include <gtest/gtest.h>

#include <vector>

namespace clusterbench {
namespace {

const std::vector<std::string> k_names{"aabb", "bounds", "planes", "sphere-refinement"};

TEST(NearestName, a_swapped_pair_of_letters_is_one_error) {
  EXPECT_EQ(nearest_name("abab", k_names), "aabb");
}

TEST(NearestName, a_missing_letter_in_a_long_name_is_found) {
  EXPECT_EQ(nearest_name("sphere-refinment", k_names), "sphere-refinement");
}

TEST(NearestName, a_word_like_none_of_them_has_no_nearest_name) {
  EXPECT_EQ(nearest_name("voxels", k_names), "");
  EXPECT_EQ(did_you_mean("voxels", k_names), "");
}

TEST(ShellCommand, quotes_what_a_shell_would_take_apart) {
  EXPECT_EQ(shell_command(std::vector<std::string>{"run", "a b.json", "", "--set=k=1,2", "it's"}),
            "run 'a b.json' '' --set=k=1,2 'it'\\''s'");
}

TEST(Printable, leaves_nothing_that_a_terminal_would_obey) {
  EXPECT_EQ(printable("lamp 3"), "lamp 3");
  EXPECT_EQ(printable("a\x1b[31mb\r\n\t\x7f"), "a?[31mb????");
  EXPECT_EQ(printable("a\xc2\x9b"
                      "31mb"),
            "a?31mb");  // U+009B, one character for ESC [
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b\xe2\x81\xa6"
                      "c\xe2\x80\xa8"),
            "a?b?c?");  // turned and broken lines
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a?b");
}

TEST(Printable, keeps_every_language) {
  const std::string names = "L\xc3\xa4mpchen \xe7\x81\xaf \xf0\x9f\x92\xa1 \xd7\xa0\xd7\xa8";
  EXPECT_EQ(printable(names), names);
}

TEST(Printable, answers_bytes_that_are_no_utf_8_one_by_one) {
  EXPECT_EQ(printable("\xff"
                      "a\xc3"),
            "?a?");
  EXPECT_EQ(printable("\xc0\x9b\xe0\x82\x9b\xed\xa0\x80\xf4\x90\x80\x80"), "????????????");
  EXPECT_EQ(printable("\xe7\x81"), "??");
}

TEST(Printable, keeps_lines_where_they_are_wanted) {
  EXPECT_EQ(printable_lines("a\nb\x1b\n"), "a\nb?\n");
}

TEST(NumberOf, has_the_plural_where_it_belongs) {
  EXPECT_EQ(number_of(0, "light"), "0 lights");
  EXPECT_EQ(number_of(1, "light"), "1 light");
  EXPECT_EQ(number_of(2, "light"), "2 lights");
}

TEST(DecimalNumber, is_all_of_a_text_or_none) {
  EXPECT_EQ(decimal_number("64"), 64.0);
  EXPECT_EQ(decimal_number("-12.5e3"), -12500.0);
  EXPECT_EQ(decimal_number(".5"), 0.5);
  EXPECT_EQ(decimal_number("0.1"), 0.1);
  EXPECT_EQ(decimal_number("1e308"), 1e308);
  EXPECT_EQ(decimal_number("5e-324"), 5e-324);
  EXPECT_EQ(decimal_number("0e-400"), 0.0);
  for (const char* text :
       {"", " 1", "1 ", "+1", "1e", "e5", "-", ".", "1.2.3", "0x10", "inf", "nan", "1e309", "1e-400", "1,5", "1f"})
    EXPECT_FALSE(decimal_number(text)) << text;
  EXPECT_EQ(decimal_number(std::string_view("12345").substr(0, 2)), 12.0) << "no longer than the text is";
}

TEST(Sha256, agrees_with_the_examples_of_fips_180) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Base64, is_decoded_with_and_without_padding_and_refused_where_it_is_none) {
  EXPECT_EQ(base64_decoded(""), "");
  EXPECT_EQ(base64_decoded("bGlnaHQ="), "light");
  EXPECT_EQ(base64_decoded("bGlnaHQ"), "light");
  EXPECT_EQ(base64_decoded("bGlnaHRz"), "lights");
  EXPECT_EQ(base64_decoded("+/8A"), std::string("\xfb\xff\0", 3));
  for (const char* text :
       {"b", "bGlnaHRzb", "bGl=aHRz", "bGl aHRz", " bGlnaHRz", "    bGln", "bGlnaHR\n", "bGlnaHR-", "bGln_HRz"})
    EXPECT_EQ(base64_decoded(text), std::nullopt) << text;
}

}  // namespace
}  // namespace clusterbench
