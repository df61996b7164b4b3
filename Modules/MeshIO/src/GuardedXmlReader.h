#pragma once

#include "GuardedXmlParser.h"

#include <vtkAbstractArray.h>
#include <vtkDataArraySelection.h>
#include <vtkStringArray.h>
#include <vtkXMLReader.h>

namespace sinew {

/// A reader of VTK's XML files, guarded against what VTK 9.1 does to damaged ones:
/// - When it cannot read an array of cells, its message asks the point data for the name, and crashes where
///   there are none. Sinew has no use for point data: the cell data stand in their place.
/// - When a cell's offset promises so many values that their bytes overflow, it writes behind its memory.
/// - It writes texts behind an array when there are more of them than the array has tuples.
/// - What GuardedXmlParser refuses.
template <class Reader>
class GuardedXmlReader : public Reader {
 public:
  static GuardedXmlReader* New() {
    auto* reader = new GuardedXmlReader;
    reader->InitializeObjectBase();
    return reader;
  }

 protected:
  void CreateXMLParser() override { this->XMLParser = GuardedXmlParser::New(); }

  int ReadPieceData() override {
    this->PointDataArraySelection->DisableAllArrays();
    this->PointDataElements[this->Piece] = this->CellDataElements[this->Piece];
    return Reader::ReadPieceData();
  }

  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType at, vtkAbstractArray* array, vtkIdType first,
                      vtkIdType count, vtkXMLReader::FieldType type) override {
    constexpr vtkIdType mostValues = vtkIdType{1} << 40;
    const bool fits = count >= 0 && count <= mostValues && at + count <= array->GetNumberOfValues();
    auto* parser = static_cast<GuardedXmlParser*>(this->XMLParser);
    if (auto* texts = vtkStringArray::SafeDownCast(array))
      return fits && parser->blocksAreSound(element) && parser->readTexts(element, at, count, texts) ? 1 : 0;
    return fits && parser->blocksAreSound(element)
               ? Reader::ReadArrayValues(element, at, array, first, count, type)
               : 0;
  }
};

}  // namespace sinew
