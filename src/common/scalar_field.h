// SPDX-License-Identifier: BSD-3-Clause
// Scalar fields of a cloud, chosen at run time by name: `density`, `vel[1]`, `|vel|`,
// `|vx,vy,vz|`.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief One number at a fixed place of every point of a cloud. */
struct PCL_UVOL_EXPORTS FieldComponent {
  std::size_t offset;    ///< bytes from the start of the point
  std::uint8_t datatype; ///< pcl::PCLPointField::PointFieldTypes

  /** \brief The number in this place of the point that starts at that byte. */
  double
  read(const std::uint8_t* point) const;
};

/** \brief A scalar per point: a component, or the Euclidean length of several. */
class PCL_UVOL_EXPORTS ScalarField {
public:
  /** \brief Resolve a name against the fields of a cloud.
   * \param expression `density`, `vel[1]` (component, from 0), `|vel|` (length of all
   * its components) or `|vx,vy,vz|` (length of several scalars). `vel[1]` and `|vel|`
   * also find the fields of findComponents().
   * \throws InvalidArgument that lists the fields there are */
  ScalarField(const std::vector<pcl::PCLPointField>& fields,
              const std::string& expression);

  /** \brief As chooseField() without a name, for a cloud whose fields are all numbers.
   * \throws InvalidArgument that lists the candidates */
  static std::string
  defaultName(const std::vector<pcl::PCLPointField>& fields);

  /** \brief The value of the point that starts at that byte; NaN where a component is.
   */
  double
  read(const std::uint8_t* point) const;

  const std::string&
  getName() const
  {
    return name_;
  }

  /** \brief The components it is made of. */
  const std::vector<FieldComponent>&
  getComponents() const
  {
    return components_;
  }

  /** \brief True for the length of its components, false for the one component. */
  bool
  isLength() const
  {
    return is_length_;
  }

private:
  std::string name_;
  bool is_length_;
  std::vector<FieldComponent> components_;
};

/** \brief "name (float32), name (float32 x 3), ...": for messages that list what is
 * there.
 */
PCL_UVOL_EXPORTS std::string
describeFields(const std::vector<pcl::PCLPointField>& fields);

/** \brief Field of that name, or null. */
PCL_UVOL_EXPORTS const pcl::PCLPointField*
findField(const std::vector<pcl::PCLPointField>& fields, const std::string& name);

/** \brief The components of the field of that name, else those of fields that are
 * called name_0, name_1, ... as PLY files name them, name:0, name:1, ..., name_x,
 * name_y, ... or namex, namey, ...; none where there is no such field. */
PCL_UVOL_EXPORTS std::vector<FieldComponent>
findComponents(const std::vector<pcl::PCLPointField>& fields, const std::string& name);

/** \brief Size in bytes of one number of a pcl::PCLPointField datatype. */
PCL_UVOL_EXPORTS std::size_t
datatypeSize(std::uint8_t datatype);

} // namespace pcl_uvol
