// Turns every tissue of a segmentation into a smoothed signed distance, with denseLevelSetFromLabels and with
// ITK's AntiAliasBinaryImageFilter and ReinitializeLevelSetImageFilter on the voxels around the same tissue,
// one after the other on one thread, and compares their CPU seconds.
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <CLI/CLI.hpp>
#include <itkAntiAliasBinaryImageFilter.h>
#include <itkImage.h>
#include <itkImageRegionIteratorWithIndex.h>
#include <itkMultiThreaderBase.h>
#include <itkReinitializeLevelSetImageFilter.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <iostream>

namespace sinew {
namespace {

using Labels = itk::Image<unsigned char, 3>;
using Field = itk::Image<float, 3>;

struct Options {
  std::string input;
  int runs = 3;
  double bandVoxels = LevelSetFromLabelsOptions{}.bandVoxels;
  double largestRmsChange = 0.01;  ///< of AntiAlias, as in ITK's example AntiAliasBinaryImageFilter.cxx
  int iterations = 50;             ///< likewise
  bool perTissue = false;
};

/// CPU seconds of one conversion.
struct Seconds {
  double sinew = 0, antiAlias = 0, reinitialize = 0;

  double itk() const { return antiAlias + reinitialize; }
};

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Function>
double timed(const Function& run) {
  const double start = cpuSeconds();
  run();
  return cpuSeconds() - start;
}

/// The voxels of a tissue, 1 in 0, with about the margin that denseLevelSetFromLabels takes: six samples of
/// its level set. Voxels beyond the image are 0.
Labels::Pointer cropImage(const Segmentation& segmentation, const Tissue& tissue) {
  constexpr double kMarginSamples = 6;
  const Eigen::Vector3d& spacing = segmentation.geometry.spacing;
  const Eigen::Vector3d reach =
      Eigen::Vector3d::Constant(kMarginSamples * defaultGridSpacing(segmentation.geometry));
  const Eigen::Vector3i margin = reach.cwiseQuotient(spacing).array().ceil().cast<int>();
  const Eigen::Vector3i lower = tissue.box.lower - margin, size = tissue.box.upper + margin - lower;
  Labels::Pointer image = Labels::New();
  Labels::SizeType extent;
  for (int a = 0; a < 3; ++a) extent[a] = static_cast<itk::SizeValueType>(size[a]);
  image->SetRegions(Labels::RegionType(extent));
  image->SetSpacing(spacing.data());
  image->Allocate(true);
  for (itk::ImageRegionIteratorWithIndex<Labels> voxel(image, image->GetLargestPossibleRegion());
       !voxel.IsAtEnd(); ++voxel) {
    const auto& index = voxel.GetIndex();
    const Eigen::Vector3i at = lower + Eigen::Vector3i(static_cast<int>(index[0]), static_cast<int>(index[1]),
                                                       static_cast<int>(index[2]));
    const bool inBox =
        (at.array() >= tissue.box.lower.array()).all() && (at.array() < tissue.box.upper.array()).all();
    voxel.Set(inBox && segmentation.at(tissue.layer, at) == tissue.label ? 1 : 0);
  }
  return image;
}

Seconds measure(const Segmentation& segmentation, const Tissue& tissue, const Options& options) {
  Seconds seconds;
  LevelSetFromLabelsOptions ours;
  ours.bandVoxels = options.bandVoxels;
  seconds.sinew = timed([&] { denseLevelSetFromLabels(segmentation, tissue, ours); });

  auto antiAlias = itk::AntiAliasBinaryImageFilter<Labels, Field>::New();
  seconds.antiAlias = timed([&] {
    antiAlias->SetInput(cropImage(segmentation, tissue));
    antiAlias->SetMaximumRMSError(options.largestRmsChange);
    antiAlias->SetNumberOfIterations(static_cast<itk::IdentifierType>(options.iterations));
    antiAlias->Update();
  });
  auto reinitialize = itk::ReinitializeLevelSetImageFilter<Field>::New();
  seconds.reinitialize = timed([&] {
    reinitialize->SetInput(antiAlias->GetOutput());
    reinitialize->NarrowBandingOn();
    reinitialize->SetOutputNarrowBandwidth(2 * options.bandVoxels *
                                           defaultGridSpacing(segmentation.geometry));
    reinitialize->Update();
  });
  return seconds;
}

/// The run with the median of Sinew's seconds over ITK's.
Seconds medianRun(const Segmentation& segmentation, const Tissue& tissue, const Options& options) {
  std::vector<Seconds> runs;
  for (int run = 0; run < options.runs; ++run) runs.push_back(measure(segmentation, tissue, options));
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end(),
                   [](const Seconds& a, const Seconds& b) { return a.sinew * b.itk() < b.sinew * a.itk(); });
  return *middle;
}

void print(const std::string& what, std::int64_t voxels, const Seconds& s) {
  std::cout << "| " << what << " | " << voxels << " | " << std::fixed << std::setprecision(3) << s.sinew
            << " | " << s.antiAlias << " | " << s.reinitialize << " | " << std::setprecision(1)
            << s.itk() / s.sinew << " |" << std::endl;
}

void run(const Options& options) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(1);
  const Segmentation segmentation = readSegmentation(options.input);
  std::cout << "| tissue | voxels | Sinew, CPU s | AntiAlias | Reinitialize | ITK over Sinew |\n"
               "|---|---:|---:|---:|---:|---:|\n";
  Seconds all;
  std::int64_t voxels = 0;
  for (const Tissue& tissue : segmentation.tissues) {
    if (tissue.voxels == 0) continue;
    const Seconds s = medianRun(segmentation, tissue, options);
    if (options.perTissue) print(tissue.name, tissue.voxels, s);
    all = {all.sinew + s.sinew, all.antiAlias + s.antiAlias, all.reinitialize + s.reinitialize};
    voxels += tissue.voxels;
  }
  print("all", voxels, all);
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  sinew::Options options;
  CLI::App app("Smoothed level sets of all tissues: Sinew against ITK's AntiAlias and Reinitialize.");
  app.add_option("INPUT", options.input, "segmentation")->required();
  app.add_option("--runs", options.runs, "runs of each tissue, of which the median counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--iterations", options.iterations, "most iterations of AntiAlias")->capture_default_str();
  app.add_option("--rms", options.largestRmsChange, "AntiAlias ends below this change")
      ->capture_default_str();
  app.add_flag("--per-tissue", options.perTissue, "one row for each tissue");
  CLI11_PARSE(app, argc, argv);
  try {
    sinew::run(options);
  } catch (const std::exception& error) {
    std::cerr << "itkLevelSets: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
