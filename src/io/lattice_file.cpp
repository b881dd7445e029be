// SPDX-License-Identifier: BSD-3-Clause
#include "io/lattice_file.h"

#include "common/numbers.h"
#include "common/scalar_field.h"
#include "io/files.h"
#include "io/xml_text.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace pcl_uvol {

using detail::Place;
using detail::QueryLattice;

namespace {

using Type = pcl::PCLPointField;

std::string
writeText(double number)
{
  std::string text;
  appendNumber(text, Type::FLOAT64, reinterpret_cast<const std::uint8_t*>(&number));
  return text;
}

std::string
writeText(const Place& place, const char* separator)
{
  return writeText(place[0]) + separator + writeText(place[1]) + separator +
         writeText(place[2]);
}

/** The names of a type of numbers in VTK's XML, NRRD and MetaImage. */
struct TypeNames {
  const char *xml, *nrrd, *meta;
};

TypeNames
namesOf(std::uint8_t datatype)
{
  switch (datatype) {
  case Type::FLOAT32:
    return {"Float32", "float", "MET_FLOAT"};
  case Type::FLOAT64:
    return {"Float64", "double", "MET_DOUBLE"};
  default:
    return {"UInt8", "uint8", "MET_UCHAR"};
  }
}

std::uint64_t
tupleBytes(const LatticeArray& array)
{
  return datatypeSize(array.datatype) * array.components;
}

/** The length of an axis' steps, and their direction. */
struct Axis {
  double spacing;
  Place direction;
};

Axis
axisOf(const QueryLattice& lattice, std::size_t axis)
{
  Axis found{lattice.spacing(axis), lattice.steps[axis]};
  for (double& component : found.direction)
    component /= found.spacing;
  return found;
}

/** A file whose parts are written in any order. */
class PlacedFile {
public:
  /** \param name the name that errors give */
  PlacedFile(const std::string& path, std::string name)
      : name_(std::move(name))
      , descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC))
  {
    if (descriptor_ < 0)
      io::throwUnwritable(name_, io::systemError());
  }
  PlacedFile(const PlacedFile&) = delete;
  PlacedFile&
  operator=(const PlacedFile&) = delete;
  ~PlacedFile()
  {
    ::close(descriptor_);
  }

  void
  write(std::uint64_t offset, const void* bytes, std::uint64_t count) const
  {
    const auto* from = static_cast<const char*>(bytes);
    while (count > 0) {
      const ssize_t done =
          ::pwrite(descriptor_, from, count, static_cast<off_t>(offset));
      if (done < 0 && errno == EINTR)
        continue;
      if (done < 0)
        io::throwUnwritable(name_, io::systemError());
      from += done;
      offset += static_cast<std::uint64_t>(done);
      count -= static_cast<std::uint64_t>(done);
    }
  }

private:
  std::string name_;
  int descriptor_;
};

/** "0 63 0 63 0 0" */
std::string
writeExtent(const QueryLattice& lattice)
{
  std::string text;
  for (const std::size_t count : lattice.counts)
    text += (text.empty() ? "0 " : " 0 ") + std::to_string(count - 1);
  return text;
}

/** A file of VTK whose arrays lie one behind the other at its end. */
class XmlLattice {
public:
  XmlLattice(const QueryLattice& lattice,
             const std::vector<LatticeArray>& arrays,
             bool has_points)
      : lattice_(lattice)
      , arrays_(arrays)
      , has_points_(has_points)
  {
    const std::string kind = has_points ? "StructuredGrid" : "ImageData";
    head_ =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind +
        "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" +
        kind + " WholeExtent=\"" + writeExtent(lattice) + '"' +
        (has_points ? "" : describeGeometry()) + ">\n<Piece Extent=\"" +
        writeExtent(lattice) + "\">\n<PointData Scalars=\"" +
        io::escapeAttribute(arrays.front().name) + "\">\n";
    for (const LatticeArray& array : arrays)
      addArray(array);
    head_ += "</PointData>\n";
    if (has_points) {
      head_ += "<Points>\n";
      addArray(points_array);
      head_ += "</Points>\n";
    }
    head_ += "</Piece>\n</" + kind + ">\n<AppendedData encoding=\"raw\">\n_";
  }

  /** Everything but the numbers of the arrays. */
  void
  writeFrame(const PlacedFile& file) const
  {
    file.write(0, head_.data(), head_.size());
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const std::uint64_t bytes =
          tupleBytes(i < arrays_.size() ? arrays_[i] : points_array) * lattice_.size();
      file.write(head_.size() + offsets_[i], &bytes, sizeof(bytes));
    }
    const std::string end = "\n</AppendedData>\n</VTKFile>\n";
    file.write(head_.size() + size_, end.data(), end.size());
    if (has_points_)
      writePoints(file);
  }

  /** Where the numbers of an array begin. */
  std::uint64_t
  beginOf(std::size_t array) const
  {
    return head_.size() + offsets_[array] + sizeof(std::uint64_t);
  }

private:
  static inline const LatticeArray points_array{"Points", Type::FLOAT64, 3};

  std::string
  describeGeometry() const
  {
    Place spacing;
    std::string direction;
    Place directions[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Axis found = axisOf(lattice_, axis);
      spacing[axis] = found.spacing;
      directions[axis] = found.direction;
    }
    for (std::size_t row = 0; row < 3; ++row)
      direction +=
          (row > 0 ? " " : "") +
          writeText({directions[0][row], directions[1][row], directions[2][row]}, " ");
    return " Origin=\"" + writeText(lattice_.origin, " ") + "\" Spacing=\"" +
           writeText(spacing, " ") + "\" Direction=\"" + direction + '"';
  }

  void
  addArray(const LatticeArray& array)
  {
    head_ += std::string("<DataArray type=\"") + namesOf(array.datatype).xml +
             "\" Name=\"" + io::escapeAttribute(array.name) +
             "\" NumberOfComponents=\"" + std::to_string(array.components) +
             "\" format=\"appended\" offset=\"" + std::to_string(size_) + "\"/>\n";
    offsets_.push_back(size_);
    size_ += sizeof(std::uint64_t) + tupleBytes(array) * lattice_.size();
  }

  void
  writePoints(const PlacedFile& file) const
  {
    constexpr std::size_t block = 1u << 16;
    std::vector<Place> places;
    for (std::size_t first = 0; first < lattice_.size(); first += block) {
      places.resize(std::min(block, lattice_.size() - first));
      for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = lattice_.at(first + i);
      file.write(beginOf(arrays_.size()) + first * sizeof(Place),
                 places.data(),
                 places.size() * sizeof(Place));
    }
  }

  const QueryLattice& lattice_;
  const std::vector<LatticeArray>& arrays_;
  bool has_points_;
  std::string head_;
  std::vector<std::uint64_t> offsets_; ///< of the arrays, then of the points
  std::uint64_t size_ = 0;
};

/** The head of a NRRD file. */
std::string
nrrdHead(const QueryLattice& lattice, const LatticeArray& array)
{
  const bool has_components = array.components > 1;
  std::string sizes = has_components ? std::to_string(array.components) + ' ' : "",
              directions = has_components ? "none " : "",
              kinds = has_components ? "vector " : "";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char* const gap = axis > 0 ? " " : "";
    sizes += gap + std::to_string(lattice.counts[axis]);
    directions += gap + ('(' + writeText(lattice.steps[axis], ",") + ')');
    kinds += std::string(gap) + "domain";
  }
  return std::string("NRRD0004\ntype: ") + namesOf(array.datatype).nrrd +
         "\ndimension: " + (has_components ? "4" : "3") +
         "\nspace dimension: 3\nsizes: " + sizes + "\nspace directions: " + directions +
         "\nkinds: " + kinds + "\nendian: little\nencoding: raw\nspace origin: (" +
         writeText(lattice.origin, ",") + ")\n\n";
}

/** The head of a MetaImage file. */
std::string
metaHead(const QueryLattice& lattice, const LatticeArray& array)
{
  Place spacing;
  std::string sizes, matrix;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Axis found = axisOf(lattice, axis);
    spacing[axis] = found.spacing;
    sizes += ' ' + std::to_string(lattice.counts[axis]);
    matrix += ' ' + writeText(found.direction, " ");
  }
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
         "BinaryDataByteOrderMSB = False\nTransformMatrix =" +
         matrix + "\nOffset = " + writeText(lattice.origin, " ") +
         "\nElementSpacing = " + writeText(spacing, " ") + "\nDimSize =" + sizes +
         "\nElementNumberOfChannels = " + std::to_string(array.components) +
         "\nElementType = " + namesOf(array.datatype).meta +
         "\nElementDataFile = LOCAL\n";
}

bool
holdsOneArray(const std::string& path)
{
  const std::string ending = io::getEnding(path);
  return ending == ".nrrd" || ending == ".mha";
}

void
saveXml(const std::string& path,
        const QueryLattice& lattice,
        const std::vector<LatticeArray>& arrays,
        const std::function<void(const PutNumbers& put)>& fill)
{
  const XmlLattice layout(lattice, arrays, io::getEnding(path) == ".vts");
  writeAtomically(path, [&](const std::string& temporary) {
    const PlacedFile file(temporary, path);
    layout.writeFrame(file);
    fill([&](std::size_t array,
             std::size_t first,
             std::size_t places,
             const void* bytes) {
      const std::uint64_t tuple = tupleBytes(arrays[array]);
      file.write(layout.beginOf(array) + first * tuple, bytes, places * tuple);
    });
  });
}

/** Opens one of several files inside the other, so that all appear or none. */
void
saveVolumes(const std::vector<std::string>& paths,
            const QueryLattice& lattice,
            const std::vector<LatticeArray>& arrays,
            const std::function<void(const PutNumbers& put)>& fill,
            std::vector<const PlacedFile*>& files)
{
  const std::size_t i = files.size();
  const auto headOf = [&](const LatticeArray& array) {
    return io::getEnding(paths.front()) == ".nrrd" ? nrrdHead(lattice, array)
                                                   : metaHead(lattice, array);
  };
  if (i == paths.size())
    return fill([&](std::size_t array,
                    std::size_t first,
                    std::size_t places,
                    const void* bytes) {
      const std::uint64_t tuple = tupleBytes(arrays[array]);
      files[array]->write(
          headOf(arrays[array]).size() + first * tuple, bytes, places * tuple);
    });
  writeAtomically(paths[i], [&](const std::string& temporary) {
    const PlacedFile file(temporary, paths[i]);
    const std::string head = headOf(arrays[i]);
    file.write(0, head.data(), head.size());
    files.push_back(&file);
    saveVolumes(paths, lattice, arrays, fill, files);
  });
}

} // namespace

void
saveLattice(const std::string& path,
            const QueryLattice& lattice,
            const std::vector<LatticeArray>& arrays,
            const std::function<void(const PutNumbers& put)>& fill)
{
  const std::vector<std::string> paths = latticeFiles(path, arrays);
  if (!holdsOneArray(path))
    return saveXml(path, lattice, arrays, fill);
  std::vector<const PlacedFile*> files;
  saveVolumes(paths, lattice, arrays, fill, files);
}

std::vector<std::string>
latticeFiles(const std::string& path, const std::vector<LatticeArray>& arrays)
{
  if (!isLatticeFile(path))
    io::throwUnwritable(path,
                        {"unwritten_ending", "grids", ".vti, .vts, .nrrd or .mha"});
  const std::string ending = io::getEnding(path);
  std::vector<std::string> paths{path};
  if (holdsOneArray(path))
    for (std::size_t i = 1; i < arrays.size(); ++i) {
      std::string name = '_' + arrays[i].name;
      std::replace(name.begin(), name.end(), '/', '_');
      paths.push_back(path);
      paths.back().insert(path.size() - ending.size(), name);
    }
  for (const std::string& file : paths)
    io::checkWritable(file);
  return paths;
}

bool
isLatticeFile(const std::string& path)
{
  const std::string ending = io::getEnding(path);
  return ending == ".vti" || ending == ".vts" || holdsOneArray(path);
}

} // namespace pcl_uvol
