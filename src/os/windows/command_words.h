#pragma once
// A command line of Windows is one text, which the program that starts splits itself.

#include <string>
#include <vector>

namespace clusterbench::os {

// The text that programs split into these words again, by the rules of CommandLineToArgvW and of Microsoft's C library:
// a word with spaces, quotes or nothing in it stands in quotes; before a quote, backslashes are doubled.
std::wstring command_text(const std::vector<std::string>& words);

// The words of a text, in UTF-8.
std::vector<std::string> words_of(const std::wstring& text);

}  // namespace clusterbench::os
