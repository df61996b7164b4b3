#include "ClassicLocale.h"
#include "LegacyVtkFile.h"
#include "MeshFormatTable.h"
#include "TissueGrid.h"
#include "VtkErrorTrap.h"

#include <vtkErrorCode.h>
#include <vtkObjectFactory.h>
#include <vtkUnstructuredGridWriter.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

/// A file that tells at its end whether all of it was taken.
class CheckedFile : public std::ofstream {
 public:
  CheckedFile(const char* name, bool& complete)
      : std::ofstream(name, std::ios::binary), complete_(complete) {}
  ~CheckedFile() override { complete_ = static_cast<bool>(flush()); }

 private:
  bool& complete_;
};

/// VTK 9.1's writer does not check its file when it closes it.
class LegacyWriter : public vtkUnstructuredGridWriter {
 public:
  static LegacyWriter* New();
  vtkTypeMacro(LegacyWriter, vtkUnstructuredGridWriter)

      bool complete() const {
    return complete_;
  }

 protected:
  ostream* OpenVTKFile() override { return new CheckedFile(GetFileName(), complete_); }

 private:
  bool complete_ = false;
};
vtkStandardNewMacro(LegacyWriter);

}  // namespace

void writeLegacyVtk(const TissueMesh& mesh, const std::filesystem::path& file,
                    const WriteMeshOptions& options) {
  constexpr int kVersion = 42;
  const std::string title =
      saysSpace(options) ? std::string("Sinew SPACE=") + toString(options.space) : "Sinew";
  const auto grid = tissueGrid(mesh, options);
  const ClassicLocale locale;
  const VtkErrorTrap trap;
  const auto writer = vtkSmartPointer<LegacyWriter>::New();
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  writer->SetFileVersion(kVersion);
  writer->SetFileTypeToBinary();
  writer->SetHeader(title.c_str());
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
    throw std::runtime_error(vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  if (trap.failed()) throw std::runtime_error(trap.firstError());
  if (!writer->complete()) throw std::runtime_error("the file is incomplete; is the disk full?");
}

}  // namespace sinew
