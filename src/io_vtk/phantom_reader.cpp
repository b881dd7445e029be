// SPDX-License-Identifier: BSD-3-Clause
// Snapshots of Phantom: all particles in one group, their kinds in a table.
#include "common/scalar_field.h"
#include "io/snapshot.h"
#include "io_vtk/hdf5_group.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t mask_rows = std::size_t(1) << 14;

/** rho = m (hfact / h)^3 of Phantom's particles (Price et al. 2018, section 2.1). */
class PhantomDensity : public FileColumn {
public:
  /** \param kinds null: all particles are of the first kind */
  PhantomDensity(std::unique_ptr<FileColumn> lengths,
                 std::uint8_t length_type,
                 std::unique_ptr<FileColumn> kinds,
                 std::vector<double> masses,
                 double factor)
      : lengths_(std::move(lengths))
      , length_{0, length_type}
      , length_bytes_(datatypeSize(length_type))
      , kinds_(std::move(kinds))
      , masses_(std::move(masses))
      , factor_(factor)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    buffer_.resize(count * length_bytes_);
    lengths_->read(first, count, buffer_.data());
    kind_buffer_.assign(count, 1);
    if (kinds_)
      kinds_->read(first, count, reinterpret_cast<std::uint8_t*>(kind_buffer_.data()));
    for (std::size_t i = 0; i < count; ++i, tuples += sizeof(double)) {
      const auto kind = static_cast<std::size_t>(std::abs(int(kind_buffer_[i])));
      const double ratio = factor_ / length_.read(buffer_.data() + i * length_bytes_);
      const double density = kind >= 1 && kind <= masses_.size()
                                 ? masses_[kind - 1] * ratio * ratio * ratio
                                 : std::numeric_limits<double>::quiet_NaN();
      std::memcpy(tuples, &density, sizeof(density));
    }
  }

private:
  std::unique_ptr<FileColumn> lengths_;
  FieldComponent length_;
  std::size_t length_bytes_;
  std::unique_ptr<FileColumn> kinds_;
  std::vector<double> masses_;
  double factor_;
  std::vector<std::uint8_t> buffer_;
  std::vector<std::int8_t> kind_buffer_;
};

/** Kinds of Phantom's particles that have names here. */
const std::map<int, const char*> phantom_kinds{{1, "gas"},
                                               {2, "dust"},
                                               {3, "boundary"},
                                               {4, "stars"},
                                               {5, "dm"},
                                               {6, "bulge"},
                                               {7, "dust"}};

/** Reads a column of one number per row to the end. */
template <typename Take>
void
forEach(FileColumn& column, std::uint8_t datatype, std::uint64_t rows, const Take& take)
{
  const std::size_t bytes = datatypeSize(datatype);
  const FieldComponent number{0, datatype};
  std::vector<std::uint8_t> block(mask_rows * bytes);
  for (std::uint64_t first = 0; first < rows; first += mask_rows) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(mask_rows, rows - first));
    column.read(first, count, block.data());
    for (std::size_t i = 0; i < count; ++i)
      take(first + i, number.read(block.data() + i * bytes));
  }
}

/** Snapshots of Phantom: all particles in one group, their kinds in a table. */
class PhantomReader {
public:
  PhantomReader(const Hdf5File& file, const std::string& particles)
      : file_(file)
      , particles_(particles)
      , reader_(file, group_)
  {
  }

  static bool
  isPhantom(const Hdf5File& file)
  {
    return file.findShape("/particles/xyz") && file.findShape("/particles/h") &&
           !file.readNumbers("/header/hfact").empty();
  }

  std::unique_ptr<RecordSource>
  open();

private:
  void
  addDensity();
  bool
  hasKinds() const;
  std::vector<std::uint64_t>
  chooseRows(std::vector<Message>& notes) const;

  const std::string group_ = "/particles";
  const Hdf5File& file_;
  const std::string& particles_;
  Hdf5Group reader_;
};

bool
PhantomReader::hasKinds() const
{
  const auto shape = file_.findShape("/particles/itype");
  return shape && shape->datatype == Type::INT8 && shape->components == 1 &&
         shape->rows == reader_.getRows();
}

void
PhantomReader::addDensity()
{
  const auto masses = file_.readNumbers("/header/massoftype");
  const auto factor = file_.readNumbers("/header/hfact");
  const auto shape = file_.findShape("/particles/h");
  if (masses.empty() || shape->components != 1 || shape->rows != reader_.getRows() ||
      file_.findShape("/particles/rho"))
    return;
  reader_.getColumns().push_back(
      {{"rho"},
       Type::FLOAT64,
       1,
       std::make_unique<PhantomDensity>(
           file_.openColumn("/particles/h"),
           shape->datatype,
           hasKinds() ? file_.openColumn("/particles/itype") : nullptr,
           masses,
           factor[0])});
}

/** Particles of the kind asked for, else all that are not dead (h <= 0). */
std::vector<std::uint64_t>
PhantomReader::chooseRows(std::vector<Message>& notes) const
{
  const std::uint64_t rows = reader_.getRows();
  std::vector<bool> kept(rows, true);
  const auto shape = file_.findShape("/particles/h");
  std::uint64_t dead = 0;
  forEach(*file_.openColumn("/particles/h"),
          shape->datatype,
          rows,
          [&](std::uint64_t row, double length) {
            kept[row] = length > 0.0;
            dead += length > 0.0 ? 0 : 1;
          });
  if (dead > 0)
    notes.push_back({"dead_particles", {{"dead", dead}}});
  std::map<int, std::uint64_t> counts;
  std::vector<std::int8_t> kinds(rows, 1);
  if (hasKinds())
    forEach(*file_.openColumn("/particles/itype"),
            Type::INT8,
            rows,
            [&](std::uint64_t row, double kind) {
              kinds[row] = static_cast<std::int8_t>(kind);
            });
  for (std::uint64_t row = 0; row < rows; ++row)
    counts[kinds[row]] += kept[row];
  if (!particles_.empty()) {
    std::vector<ParticleKind> list;
    for (const auto& [kind, count] : counts)
      if (kind >= 0)
        list.push_back({static_cast<std::size_t>(kind),
                        phantom_kinds.count(kind) ? phantom_kinds.at(kind) : "",
                        count});
    const std::size_t kind = chooseKind(file_.getPath(), list, particles_, notes);
    for (std::uint64_t row = 0; row < rows; ++row)
      kept[row] = kept[row] && kinds[row] == static_cast<int>(kind);
  }
  std::vector<std::uint64_t> chosen;
  for (std::uint64_t row = 0; row < rows; ++row)
    if (kept[row])
      chosen.push_back(row);
  return chosen;
}

std::unique_ptr<RecordSource>
PhantomReader::open()
{
  reader_.takeCoordinates({"xyz"});
  const auto lengths = file_.findShape("/particles/h");
  if (lengths->rows != reader_.getRows() || lengths->components != 1)
    throwUnreadable(file_.getPath(),
                    {"wrong_count", "h", lengths->rows, "rows", reader_.getRows()});
  reader_.takeFields(group_);
  addDensity();
  std::vector<Message> notes;
  std::vector<std::uint64_t> rows = chooseRows(notes);
  const std::uint64_t all = reader_.getRows();
  auto source = reader_.open(std::move(notes));
  if (rows.size() == all)
    return source;
  return std::make_unique<SelectedSource>(std::move(source), std::move(rows));
}

} // namespace

std::unique_ptr<RecordSource>
openPhantom(const Hdf5File& file, const std::string& particles)
{
  if (!PhantomReader::isPhantom(file))
    return nullptr;
  auto source = PhantomReader(file, particles).open();
  const auto time = file.readNumbers("/header/time");
  if (!time.empty())
    source->setTime(time[0]);
  return source;
}

} // namespace io
} // namespace pcl_uvol
