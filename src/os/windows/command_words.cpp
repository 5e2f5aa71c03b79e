#include "os/windows/command_words.h"

#include <string_view>

#include "os/windows/windows_api.h"

#include <shellapi.h>

namespace clusterbench::os {
namespace {

std::wstring quoted_word(std::wstring_view word) {
  if (!word.empty() && word.find_first_of(L" \t\n\v\"") == std::wstring_view::npos) return std::wstring(word);
  std::wstring out = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t letter : word) {
    if (letter == L'"') out.append(backslashes + 1, L'\\');
    backslashes = letter == L'\\' ? backslashes + 1 : 0;
    out += letter;
  }
  return out.append(backslashes, L'\\') + L'"';
}

}  // namespace

std::wstring command_text(const std::vector<std::string>& words) {
  std::wstring text;
  for (const std::string& word : words) text += (text.empty() ? L"" : L" ") + quoted_word(wide(word));
  return text;
}

std::vector<std::string> words_of(const std::wstring& text) {
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(text.c_str(), &count);
  std::vector<std::string> out;
  for (int i = 0; i < count; ++i) out.push_back(narrow(words[i]));
  ::LocalFree(words);
  return out;
}

}  // namespace clusterbench::os
