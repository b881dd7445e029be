// SPDX-License-Identifier: BSD-3-Clause
#include "io/rank_files.h"

#include "common/printable.h"
#include "common/records.h"
#include "common/scalar_field.h"
#include "distributed/byte_stream.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/point_stream.h"
#include "io/vtk_library.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <filesystem>
#include <glob.h>
#include <iterator>
#include <system_error>
#include <unistd.h>

namespace pcl_uvol {
namespace {

std::vector<std::string>
matching(const std::string& pattern)
{
  glob_t found{};
  std::vector<std::string> paths;
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0)
    paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (paths.empty())
    io::throwUnreadable(pattern, "no_matching_file");
  return paths;
}

std::size_t
countPoints(const Dataset& dataset)
{
  return std::size_t(dataset.cloud.width) * dataset.cloud.height;
}

void
checkCount(std::uint64_t count)
{
  if (count > most_points)
    throw InvalidArgument("too_many_points_for_process",
                          {{"points", count}, {"most", most_points}});
}

/** A share of a number of things. */
std::uint64_t
shareBegin(std::uint64_t count, std::uint64_t rank, const Communicator& communicator)
{
  return count / communicator.size() * rank +
         count % communicator.size() * rank / communicator.size();
}

Dataset
loadRange(const std::string& path,
          const LoadOptions& options,
          const Communicator& communicator)
{
  PointStream stream(path, options);
  if (stream.size() == 0)
    throw InvalidArgument("no_points", {{"path", path}});
  const std::uint64_t begin =
                          shareBegin(stream.size(), communicator.rank(), communicator),
                      end = shareBegin(
                          stream.size(), communicator.rank() + 1, communicator);
  checkCount(end - begin);
  Dataset part = stream.getHeader();
  stream.seek(begin);
  stream.read(static_cast<std::size_t>(end - begin), part.cloud);
  return part;
}

/** What pieces have to agree in. */
struct Layout {
  std::string path; ///< of the piece that it comes from; "": there is none
  pcl::uindex_t point_step = 0;
  bool double_coordinates = false;
  Fields fields;
  LabelNames labels;           ///< those of all pieces
  std::array<double, 3> box{}; ///< none, unless all name the same one

  Layout() = default;
  Layout(std::string name, const Dataset& dataset)
      : path(std::move(name))
      , point_step(dataset.cloud.point_step)
      , double_coordinates(dataset.double_coordinates)
      , fields(dataset.cloud.fields)
      , labels(dataset.labels)
      , box(dataset.box)
  {
  }
  explicit Layout(const Bytes& message)
  {
    ByteReader reader(message);
    const auto getText = [&] {
      std::vector<char> text;
      reader.get(text);
      return std::string(text.begin(), text.end());
    };
    path = getText();
    point_step = reader.get<pcl::uindex_t>();
    double_coordinates = reader.get<bool>();
    box = reader.get<std::array<double, 3>>();
    for (auto columns = reader.get<std::uint64_t>(); columns > 0; --columns) {
      std::vector<std::string>& names = labels[getText()];
      for (auto count = reader.get<std::uint64_t>(); count > 0; --count)
        names.push_back(getText());
    }
    while (!reader.atEnd()) {
      pcl::PCLPointField field;
      field.name = getText();
      field.offset = reader.get<pcl::uindex_t>();
      field.datatype = reader.get<std::uint8_t>();
      field.count = reader.get<pcl::uindex_t>();
      fields.push_back(field);
    }
  }

  Bytes
  toMessage() const
  {
    Bytes message;
    ByteWriter writer(message);
    const auto putText = [&](const std::string& text) {
      writer.put(std::vector<char>(text.begin(), text.end()));
    };
    putText(path);
    writer.put(point_step);
    writer.put(double_coordinates);
    writer.put(box);
    writer.put(std::uint64_t{labels.size()});
    for (const auto& [field, names] : labels) {
      putText(field);
      writer.put(std::uint64_t{names.size()});
      std::for_each(names.begin(), names.end(), putText);
    }
    for (const auto& field : fields) {
      putText(field.name);
      writer.put(field.offset);
      writer.put(field.datatype);
      writer.put(field.count);
    }
    return message;
  }

  /** \throws InvalidArgument if another piece has other fields */
  void
  requireFieldsOf(const Layout& other) const
  {
    // In the order of their names, whichever process reads which.
    const bool is_first = path < other.path;
    const Layout &one = is_first ? *this : other, &another = is_first ? other : *this;
    const auto [own, its] =
        std::mismatch(one.fields.begin(),
                      one.fields.end(),
                      another.fields.begin(),
                      another.fields.end(),
                      [](const auto& a, const auto& b) {
                        return a.name == b.name && a.offset == b.offset &&
                               a.datatype == b.datatype && a.count == b.count;
                      });
    if (own == one.fields.end() && its == another.fields.end())
      return;
    const auto describe = [](const auto& field, const auto& end) {
      return field == end ? "none" : describeFields({*field});
    };
    throw InvalidArgument("pieces_of_other_fields",
                          {{"one", one.path},
                           {"other", another.path},
                           {"fields", describe(own, one.fields.end())},
                           {"other_fields", describe(its, another.fields.end())}});
  }

  /** Numbers of another piece would be taken for those of names.
   * \throws InvalidArgument if a field holds names here and none there */
  void
  requireNamesIn(const Layout& other) const
  {
    for (const auto& [field, names] : labels)
      if (findLabels(fields, labels, field) &&
          !findLabels(other.fields, other.labels, field))
        throw InvalidArgument(
            "names_in_one_piece",
            {{"field", shortenText(field)}, {"path", path}, {"other", other.path}});
  }

  /** Take what another piece has.
   * \throws InvalidArgument for other fields */
  void
  join(const Layout& other)
  {
    if (other.path.empty())
      return;
    if (path.empty()) {
      *this = other;
      return;
    }
    requireFieldsOf(other);
    requireNamesIn(other);
    other.requireNamesIn(*this);
    double_coordinates |= other.double_coordinates;
    if (box != other.box)
      box = {};
    for (const auto& [field, names] : other.labels) {
      const std::vector<std::string> own = std::move(labels[field]);
      labels[field].clear();
      std::set_union(own.begin(),
                     own.end(),
                     names.begin(),
                     names.end(),
                     std::back_inserter(labels[field]));
    }
  }
};

/** Pieces that one process reads, as one cloud. */
class PieceCollector {
public:
  explicit PieceCollector(Communicator& communicator)
      : communicator_(communicator)
  {
  }

  void
  add(const std::string& path, const Dataset& piece)
  {
    part_.notes.insert(part_.notes.end(), piece.notes.begin(), piece.notes.end());
    part_.has_coordinates = piece.has_coordinates;
    if (countPoints(piece) == 0) // VTK writes such pieces without their arrays
      return;
    layout_.join({path, piece});
    auto& cloud = part_.cloud;
    if (pieces_.empty())
      part_.cloud = piece.cloud;
    else {
      cloud.data.insert(
          cloud.data.end(), piece.cloud.data.begin(), piece.cloud.data.end());
      checkCount(std::uint64_t(cloud.width) + countPoints(piece));
      cloud.width += static_cast<pcl::uindex_t>(countPoints(piece));
    }
    pieces_.push_back({countPoints(piece), piece.origin, piece.labels});
  }

  Dataset
  finish(const std::vector<std::string>& paths)
  {
    for (const Bytes& message : communicator_.allGather(layout_.toMessage()))
      layout_.join(Layout(message));
    if (layout_.path.empty()) {
      if (paths.size() == 1)
        throw InvalidArgument("no_points", {{"path", paths[0]}});
      throw InvalidArgument("pieces_without_points", {{"pieces", paths.size()}});
    }
    auto& cloud = part_.cloud;
    cloud.fields = layout_.fields;
    cloud.point_step = layout_.point_step;
    cloud.height = 1;
    cloud.row_step = cloud.width * cloud.point_step;
    part_.double_coordinates = layout_.double_coordinates;
    if (part_.double_coordinates)
      findCommonOrigin();
    part_.labels = layout_.labels;
    part_.box = layout_.box;
    for (const auto& [field, names] : part_.labels)
      if (findLabels(cloud.fields, part_.labels, field))
        numberLabels(*findField(cloud.fields, field), names);
    return std::move(part_);
  }

private:
  struct Piece {
    std::size_t points;
    std::array<double, 3> origin;
    LabelNames labels;
  };

  /** Call visit(coordinates in double, point) for all. */
  template <typename Visit>
  void
  forPoints(const Visit& visit)
  {
    std::uint8_t* point = part_.cloud.data.data();
    for (const Piece& piece : pieces_) {
      const std::array<double, 3>& origin = piece.origin;
      for (std::size_t i = 0; i < piece.points; ++i, point += part_.cloud.point_step) {
        std::array<float, 3> relative;
        std::memcpy(relative.data(), point, sizeof(relative));
        visit(
            {origin[0] + relative[0], origin[1] + relative[1], origin[2] + relative[2]},
            point);
      }
    }
  }

  /** Each piece counts the names that it has: count those of all pieces instead. */
  void
  numberLabels(const pcl::PCLPointField& field, const std::vector<std::string>& names)
  {
    std::uint8_t* label = part_.cloud.data.data() + field.offset;
    for (const Piece& piece : pieces_) {
      const auto own = piece.labels.find(field.name);
      for (std::size_t i = 0; i < piece.points; ++i, label += part_.cloud.point_step) {
        std::int32_t number;
        std::memcpy(&number, label, sizeof(number));
        const std::string name =
            own == piece.labels.end() ? "" : nameOfLabel(own->second, number);
        if (name.empty())
          continue;
        number = static_cast<std::int32_t>(
            std::lower_bound(names.begin(), names.end(), name) - names.begin());
        std::memcpy(label, &number, sizeof(number));
      }
    }
  }

  void
  findCommonOrigin()
  {
    using Point = CoordinateRange::Point;
    std::vector<CoordinateRange> own(1);
    forPoints([&](const Point& point, const std::uint8_t*) { own[0].add(point); });
    CoordinateRange range;
    for (const CoordinateRange& other : allGatherItems(communicator_, own))
      range.add(other);
    part_.origin = findOrigin(range, part_.notes);
    forPoints([&](const Point& point, std::uint8_t* bytes) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        putCoordinate(point[axis] - part_.origin[axis], axis, bytes);
    });
  }

  Communicator& communicator_;
  Dataset part_;
  Layout layout_;
  std::vector<Piece> pieces_;
};

/** The options by which all pieces come onto one map: that of the first one. */
LoadOptions
onMapOfFirst(const std::vector<std::string>& paths, const LoadOptions& options)
{
  LoadOptions common = options;
  const io::FileFormat format = io::findFormat(paths[0], options);
  if (format == io::FileFormat::Netcdf ||
      (options.map && format == io::FileFormat::Text))
    if (const auto map = findMap(PointStream(paths[0], options).getHeader()))
      common.map = map;
  return common;
}

Dataset
loadPieces(const std::vector<std::string>& paths,
           const LoadOptions& options,
           Communicator& communicator)
{
  const LoadOptions common = onMapOfFirst(paths, options);
  PieceCollector collector(communicator);
  const auto begin = shareBegin(paths.size(), communicator.rank(), communicator),
             end = shareBegin(paths.size(), communicator.rank() + 1, communicator);
  for (std::size_t i = begin; i < end; ++i)
    collector.add(paths[i], loadDataset(paths[i], common));
  return collector.finish(paths);
}

/** name.pvtp -> name_<rank>.vtp */
std::string
pieceName(const std::string& path, std::size_t rank)
{
  std::filesystem::path name(path);
  name.replace_extension();
  return name.string() + '_' + std::to_string(rank) + ".vtp";
}

/** Pieces that a list names, and that fewer processes do not write again. */
std::vector<std::string>
findOldPieces(const std::string& path, std::size_t ranks)
{
  std::vector<std::string> old;
  try {
    const std::vector<std::string> listed = io::vtkLibrary().readPieceList(path);
    for (std::size_t rank = ranks; rank < listed.size(); ++rank)
      if (const std::string piece = pieceName(path, rank);
          std::find(listed.begin(), listed.end(), piece) != listed.end())
        old.push_back(piece);
  }
  catch (const IOError&) {
    // There is no list, or it is none of ours.
  }
  return old;
}

} // namespace

std::vector<std::string>
findPieces(const std::vector<std::string>& paths)
{
  std::vector<std::string> pieces;
  for (const std::string& path : paths) {
    std::error_code ignored; // of a pattern that is no name
    const bool is_pattern = path.find_first_of("*?[") != std::string::npos &&
                            !std::filesystem::exists(path, ignored);
    for (const std::string& name :
         is_pattern ? matching(path) : std::vector<std::string>{path})
      if (io::getEnding(name) == ".pvtp")
        for (const std::string& piece : io::vtkLibrary().readPieceList(name))
          pieces.push_back(piece);
      else
        pieces.push_back(name);
  }
  return pieces;
}

Dataset
loadPart(const std::vector<std::string>& paths,
         const LoadOptions& options,
         Communicator& communicator)
{
  if (paths.empty())
    throw InvalidArgument("no_file_to_read", {});
  if (paths.size() > 1 || io::findFormat(paths[0], options) == io::FileFormat::Vtk)
    return loadPieces(paths, options, communicator);
  Dataset part = loadRange(paths[0], options, communicator);
  communicator.barrier();
  return part;
}

void
checkSavePieces(const std::string& path)
{
  if (io::getEnding(path) != ".pvtp")
    io::throwUnwritable(path, {"unwritten_ending", "lists of pieces", ".pvtp"});
  io::checkWritable(path);
}

std::vector<std::string>
listPieces(const std::string& path, std::size_t ranks)
{
  std::vector<std::string> pieces;
  for (std::size_t rank = 0; rank < ranks; ++rank)
    pieces.push_back(pieceName(path, rank));
  return pieces;
}

void
savePieces(const std::string& path, const Dataset& part, Communicator& communicator)
{
  const std::vector<std::string> pieces = listPieces(path, communicator.size());
  const std::string& own = pieces[communicator.rank()];
  bool is_there = false;
  try {
    writeAtomically(own, [&](const std::string& file) {
      io::vtkLibrary().writeVtp(file, own, part, {});
      communicator.barrier(); // whoever cannot write keeps all from taking their places
    });
    is_there = true;
    communicator.barrier();
    if (communicator.rank() == 0) {
      const std::vector<std::string> old = findOldPieces(path, communicator.size());
      writeAtomically(path, [&](const std::string& file) {
        io::vtkLibrary().writePieceList(file, path, part, pieces);
      });
      for (const std::string& piece : old)
        ::unlink(piece.c_str());
    }
    communicator.barrier();
  }
  catch (...) {
    if (is_there)
      ::unlink(own.c_str());
    throw;
  }
}

} // namespace pcl_uvol
