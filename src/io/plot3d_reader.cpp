// SPDX-License-Identifier: BSD-3-Clause
// Grids of PLOT3D with their solutions (Walatka et al., PLOT3D User's Manual, 1990):
// binary, whole, in both byte orders, single or double, with and without the marks that
// Fortran puts around records, of one grid or several, with and without blanking.
#include "io/column_source.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/little_endian.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <functional>
#include <system_error>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

/** Bytes of a whole number, and of the mark on either side of a record. */
constexpr std::uint64_t word = 4;
constexpr std::uint32_t most_grids = 100000;
/** In front of a solution: Mach number, angle of attack, Reynolds number and time. */
constexpr std::uint64_t conditions = 4;
constexpr std::uint64_t solution_numbers = 5;

/** What the header of a file does not tell. */
struct Layout {
  bool swapped = false, marked = false, several = false, doubles = false,
       blanked = false;

  std::uint64_t
  getMark() const
  {
    return marked ? word : 0;
  }
  std::uint64_t
  getReal() const
  {
    return doubles ? 8 : 4;
  }
};

std::vector<Layout>
listLayouts()
{
  std::vector<Layout> layouts;
  for (int i = 0; i < 32; ++i)
    layouts.push_back(
        {(i & 16) != 0, (i & 8) != 0, (i & 4) != 0, (i & 2) != 0, (i & 1) != 0});
  return layouts;
}

/** A grid, and where its numbers begin. */
struct Grid {
  std::array<std::uint64_t, 3> sizes{};
  std::uint64_t points = 0;
  std::uint64_t begin = 0;
};

/** Reads the head of a file in some layout. */
class HeadReader {
public:
  HeadReader(const InputFile& file, const Layout& layout)
      : file_(file)
      , layout_(layout)
  {
  }

  /** \brief The grids by their sizes, for numbers of that many bytes in each.
   *
   * \param bytes_of a grid of so many points, with the marks of its records
   *
   * \return none where the file has not the size that these make */
  std::vector<Grid>
  findGrids(const std::function<std::uint64_t(std::uint64_t points)>& bytes_of)
  {
    const std::uint64_t mark = layout_.getMark();
    std::uint32_t count = 1;
    if (layout_.several) {
      place_ += mark;
      count = takeNumber();
      place_ += mark;
    }
    if (count == 0 || count > most_grids ||
        place_ + 2 * mark + 3 * word * count > file_.getSize())
      return {};
    place_ += mark;
    std::vector<Grid> grids(count);
    for (Grid& grid : grids) {
      grid.points = 1;
      for (std::uint64_t& size : grid.sizes) {
        size = takeNumber();
        if (size == 0 || size > file_.getSize() / grid.points)
          return {};
        grid.points *= size;
      }
    }
    place_ += mark;
    for (Grid& grid : grids) {
      grid.begin = place_;
      place_ += bytes_of(grid.points);
    }
    return place_ == file_.getSize() ? grids : std::vector<Grid>();
  }

private:
  std::uint32_t
  takeNumber()
  {
    std::uint32_t number = 0;
    if (place_ + word > file_.getSize())
      return 0;
    file_.read(place_, &number, word);
    place_ += word;
    if (layout_.swapped)
      swapBytes(reinterpret_cast<std::uint8_t*>(&number), word, 1);
    return number;
  }

  const InputFile& file_;
  const Layout& layout_;
  std::uint64_t place_ = 0;
};

std::vector<Grid>
findGrids(const InputFile& file, const Layout& layout)
{
  return HeadReader(file, layout).findGrids([&](std::uint64_t points) {
    return 2 * layout.getMark() +
           points * (3 * layout.getReal() + (layout.blanked ? word : 0));
  });
}

std::vector<Grid>
findSolutions(const InputFile& file, const Layout& layout)
{
  return HeadReader(file, layout).findGrids([&](std::uint64_t points) {
    return 4 * layout.getMark() +
           (conditions + solution_numbers * points) * layout.getReal();
  });
}

/** Numbers that stand plane by plane, as tuples. */
class PlanesColumn : public FileColumn {
public:
  explicit PlanesColumn(std::vector<std::unique_ptr<FileColumn>> planes,
                        std::size_t number_bytes)
      : planes_(std::move(planes))
      , number_bytes_(number_bytes)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    plane_.resize(count * number_bytes_);
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      planes_[k]->read(first, count, plane_.data());
      for (std::size_t i = 0; i < count; ++i)
        std::memcpy(tuples + (i * planes_.size() + k) * number_bytes_,
                    &plane_[i * number_bytes_],
                    number_bytes_);
    }
  }

private:
  std::vector<std::unique_ptr<FileColumn>> planes_;
  std::size_t number_bytes_;
  std::vector<std::uint8_t> plane_;
};

/** The grids of a file, and its layout.
 * \throws IOError where no layout fits */
std::vector<Grid>
findGrids(const std::string& path, const InputFile& file, Layout& layout)
{
  for (const Layout& possible : listLayouts()) {
    auto grids = findGrids(file, possible);
    if (grids.empty())
      continue;
    layout = possible;
    return grids;
  }
  throwUnreadable(path,
                  {"not_format", "a complete, binary PLOT3D grid in three dimensions"});
}

/** A file of grids and the one of their solutions. */
struct Plot3dFiles {
  std::shared_ptr<const InputFile> grid_file, solution_file; ///< the second may be null
  Layout layout, solution_layout;
  std::vector<Grid> grids, solutions;
};

std::unique_ptr<RecordSource>
openGrid(const Plot3dFiles& files, std::size_t index)
{
  const auto plane = [](const std::shared_ptr<const InputFile>& file,
                        const Layout& layout,
                        std::uint64_t begin) {
    return openStored(
        file, begin, layout.doubles ? Type::FLOAT64 : Type::FLOAT32, 1, layout.swapped);
  };
  const auto type_of = [](const Layout& layout) {
    return static_cast<std::uint8_t>(layout.doubles ? Type::FLOAT64 : Type::FLOAT32);
  };
  std::vector<NamedColumn> columns;
  const Grid& grid = files.grids[index];
  const Layout& layout = files.layout;
  const std::uint64_t bytes = grid.points * layout.getReal();
  std::uint64_t begin = grid.begin + layout.getMark();
  for (const char* const axis : {"x", "y", "z"}) {
    columns.push_back(
        {{axis}, type_of(layout), 1, plane(files.grid_file, layout, begin)});
    begin += bytes;
  }
  if (layout.blanked)
    columns.push_back(
        {{"iblank"},
         Type::INT32,
         1,
         openStored(files.grid_file, begin, Type::INT32, 1, layout.swapped)});
  if (!files.solution_file)
    return std::make_unique<ColumnSource>(
        grid.points, std::move(columns), std::vector<Message>());
  const Layout& of_solution = files.solution_layout;
  const std::uint64_t step = grid.points * of_solution.getReal();
  const std::uint64_t first = files.solutions[index].begin + 3 * of_solution.getMark() +
                              conditions * of_solution.getReal();
  const auto number = [&](std::uint64_t which) {
    return plane(files.solution_file, of_solution, first + which * step);
  };
  columns.push_back({{"Density"}, type_of(of_solution), 1, number(0)});
  std::vector<std::unique_ptr<FileColumn>> momentum;
  for (std::uint64_t axis = 1; axis <= 3; ++axis)
    momentum.push_back(number(axis));
  columns.push_back(
      {{"Momentum"},
       type_of(of_solution),
       3,
       std::make_unique<PlanesColumn>(std::move(momentum), of_solution.getReal())});
  columns.push_back({{"StagnationEnergy"}, type_of(of_solution), 1, number(4)});
  return std::make_unique<ColumnSource>(
      grid.points, std::move(columns), std::vector<Message>());
}

/** combxyz.bin has its solution in combq.bin, grid.p3d in grid.q. */
std::string
findSolutionFile(const std::string& path)
{
  const std::filesystem::path grid(path);
  std::string stem = grid.stem().string(), ending = grid.extension().string();
  const std::size_t xyz = stem.rfind("xyz");
  if (xyz != std::string::npos)
    stem.replace(xyz, 3, "q");
  else
    ending = ".q";
  const std::string found = (grid.parent_path() / (stem + ending)).string();
  std::error_code ignored; // of a name that is too long
  return std::filesystem::exists(found, ignored) ? found : "";
}

} // namespace

bool
isPlot3d(const std::string& path)
{
  const std::filesystem::path name(path);
  const std::string stem = name.stem().string();
  return getEnding(path) == ".p3d" || (getEnding(path) == ".bin" && stem.size() >= 3 &&
                                       stem.compare(stem.size() - 3, 3, "xyz") == 0);
}

std::vector<std::array<std::uint64_t, 3>>
readPlot3dSizes(const std::string& path)
{
  Layout layout;
  std::vector<std::array<std::uint64_t, 3>> sizes;
  for (const Grid& grid : findGrids(path, InputFile(path), layout))
    sizes.push_back(grid.sizes);
  return sizes;
}

std::unique_ptr<RecordSource>
openPlot3d(const std::string& path)
{
  auto files = std::make_shared<Plot3dFiles>();
  files->grid_file = std::make_shared<InputFile>(path);
  files->grids = findGrids(path, *files->grid_file, files->layout);
  const std::string solution = findSolutionFile(path);
  if (!solution.empty()) {
    files->solution_file = std::make_shared<InputFile>(solution);
    for (const Layout& layout : listLayouts())
      if (files->solutions.empty() && !layout.blanked) {
        files->solution_layout = layout;
        files->solutions = findSolutions(*files->solution_file, layout);
      }
    const auto same = [](const Grid& a, const Grid& b) { return a.points == b.points; };
    if (!std::equal(files->grids.begin(),
                    files->grids.end(),
                    files->solutions.begin(),
                    files->solutions.end(),
                    same))
      throwUnreadable(
          solution,
          {"disagreeing_parts", "its size and that of the grids in '" + path + "'"});
  }
  auto source = std::make_unique<PartsSource>(
      files->grids.size(),
      [files](std::size_t i) { return openGrid(*files, i); },
      [path](std::size_t) { return path; });
  return source;
}

} // namespace io
} // namespace pcl_uvol
