#pragma once

namespace sinew {

/// While one lives, the whole process writes and reads numbers with a point and without marks between
/// thousands: VTK's streams follow std::locale::global. The last one puts the languages of C and C++ back.
/// Does nothing in a process that has chosen none, as programs without a user interface mostly have not.
class ClassicLocale {
 public:
  ClassicLocale();
  ~ClassicLocale();
  ClassicLocale(const ClassicLocale&) = delete;
  ClassicLocale& operator=(const ClassicLocale&) = delete;
};

}  // namespace sinew
