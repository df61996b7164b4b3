#pragma once

#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <clocale>
#include <cstdlib>
#include <locale>
#include <string>

namespace sinew::test {

/// While it lives, C and C++ write 1234.5 as 1.234,5, as in Germany.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale(), new Decimals))) {
    numeric_ = std::setlocale(LC_NUMERIC, nullptr);
    if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8")) makeOne();
  }
  ~CommaLocale() {
    std::setlocale(LC_NUMERIC, numeric_.c_str());
    std::locale::global(before_);
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  /// Whether C's functions have it, too; the C++ streams always do.
  static bool inC() { return *std::localeconv()->decimal_point == ','; }

 private:
  class Decimals : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };

  /// Small systems have no German, but mostly what it takes to make a locale of commas.
  void makeOne() {
    writeBytes(folder_ / "commas",
               "comment_char %\nescape_char /\nLC_NUMERIC\ndecimal_point \"<U002C>\"\n"
               "thousands_sep \"<U002E>\"\ngrouping 3;3\nEND LC_NUMERIC\n");
    const std::string folder = folder_.path().string();
    // It warns of the categories that are missing, and so returns 1.
    std::string command = "localedef -c -f ANSI_X3.4-1968 -i ";
    command.append(folder).append("/commas ").append(folder).append("/xx >/dev/null 2>&1");
    static_cast<void>(std::system(command.c_str()));
    setenv("LOCPATH", folder_.path().c_str(), 1);
    std::setlocale(LC_NUMERIC, "xx");
    unsetenv("LOCPATH");
  }

  TempFolder folder_;
  std::locale before_;
  std::string numeric_;
};

}  // namespace sinew::test
