#include "ClassicLocale.h"

#include <clocale>
#include <locale>
#include <mutex>
#include <optional>
#include <string>

namespace sinew {
namespace {

struct Languages {
  std::locale streams;
  std::string functions;  ///< C's
};

std::mutex mutex;
int users = 0;
std::optional<Languages> before;

bool isClassic(const Languages& languages) {
  return languages.streams == std::locale::classic() && languages.functions == "C";
}

}  // namespace

ClassicLocale::ClassicLocale() {
  const std::lock_guard lock(mutex);
  if (users++ > 0) return;
  const Languages now{std::locale(), std::setlocale(LC_ALL, nullptr)};
  if (isClassic(now)) return;
  before = now;
  std::locale::global(std::locale::classic());  // C's, too
}

ClassicLocale::~ClassicLocale() {
  const std::lock_guard lock(mutex);
  if (--users > 0 || !before) return;
  std::locale::global(before->streams);
  std::setlocale(LC_ALL, before->functions.c_str());
  before.reset();
}

}  // namespace sinew
