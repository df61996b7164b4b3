#pragma once

#include <vtkStringArray.h>
#include <vtkXMLDataParser.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sinew {

/// VTK's parser, which refuses what VTK 9.1 takes a file's word for: it then divides by zero, reads behind
/// its memory, or counts to 2^31.
class GuardedXmlParser : public vtkXMLDataParser {
 public:
  static GuardedXmlParser* New();
  vtkTypeMacro(GuardedXmlParser, vtkXMLDataParser)

      GuardedXmlParser(const GuardedXmlParser&) = delete;
  GuardedXmlParser& operator=(const GuardedXmlParser&) = delete;

  /// @return 0, with an error, also where elements are nested too deep, arrays have no known type, or more is
  /// promised than the file can hold
  int Parse() override;

  /// Do the sizes of an array's compressed blocks fit together, and in the file? True for arrays that are not
  /// compressed.
  bool blocksAreSound(vtkXMLDataElement* array);

  /// Reads the texts of an array, `count` at most, the first one to the place `at`; a megabyte of them at
  /// most.
  bool readTexts(vtkXMLDataElement* element, vtkIdType at, vtkIdType count, vtkStringArray* texts);

 protected:
  GuardedXmlParser() = default;
  void StartElement(const char* name, const char** attributes) override;
  void EndElement(const char* name) override;

 private:
  /// Adds up an attribute `NumberOf...`.
  void notePromise(const std::string& attribute, const char* value);
  /// Sets DataStream to where an array's bytes begin.
  void goToData(vtkXMLDataElement* array);
  /// The next words of a header; none when it ends.
  std::vector<std::uint64_t> readWords(std::size_t count);
  /// Reads the header of a compressed array.
  bool sizesAreSound();

  double fileBytes_ = 0;
  double promised_ = 0;  ///< tuples, points and cells
  int depth_ = 0;
  std::string refusal_;
};

}  // namespace sinew
