// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of scattered points in a VTK pipeline.
#pragma once

#include <pcl_uvol/filters/vtkUvolFilter.h>

#include <vtkContourValues.h>
#include <vtkNew.h>

#include <memory>
#include <vector>

/** \brief Isosurfaces straight from samples, without grid or mesh: what
 * pcl_uvol::IsosurfaceExtraction and the tool uvol_isosurface find.
 *
 * \code
 * vtkNew<vtkUvolIsosurface> isosurface;
 * isosurface->SetInputConnection(reader->GetOutputPort());
 * isosurface->SetInputArrayToProcess(
 *     0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density");
 * isosurface->SetValue(0, 0.5);
 * \endcode
 * Default is the active scalars of points. Output arrays besides those of the input:
 * Normals (active, to the outside), isovalue, mean_curvature, error, edge_length,
 * support; see PointIso. Samples and tree are kept until the input changes, so that
 * further isovalues and arrays are quick: about 60 bytes per sample besides a copy of
 * the arrays. */
class PCL_UVOL_EXPORTS vtkUvolIsosurface : public vtkUvolFilter {
public:
  vtkTypeMacro(vtkUvolIsosurface, vtkUvolFilter);
  /** \return A new object, to be held by a vtkNew or vtkSmartPointer. */
  static vtkUvolIsosurface*
  New();

  /** \brief Write the settings, as VTK's classes do.
   * \param out where to
   * \param indent in front of each line */
  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief Isovalues in units of the array, as those of vtkContourFilter. Default:
   * one, 0.
   * \param i index of the isovalue; the list grows to hold it
   * \param value in units of the array */
  void
  SetValue(int i, double value)
  {
    this->Values->SetValue(i, value);
  }

  /** \brief An isovalue, in units of the array.
   * \param i index of the isovalue, below GetNumberOfContours() */
  double
  GetValue(int i)
  {
    return this->Values->GetValue(i);
  }

  /** \brief Cut or lengthen the list of isovalues.
   * \param number of isovalues that it then has */
  void
  SetNumberOfContours(int number)
  {
    this->Values->SetNumberOfContours(number);
  }

  /** \return The number of isovalues. */
  int
  GetNumberOfContours()
  {
    return this->Values->GetNumberOfContours();
  }

  /** \brief Isovalues at even distances.
   * \param number of isovalues
   * \param first in units of the array
   * \param last in units of the array */
  void
  GenerateValues(int number, double first, double last)
  {
    this->Values->GenerateValues(number, first, last);
  }

  /** \brief The zero-based component of an array of several components; -1: their
   * length. Default 0. @{ */
  vtkSetClampMacro(ArrayComponent, int, -1, VTK_INT_MAX);
  vtkGetMacro(ArrayComponent, int);
  /** @} */

  enum OutsideSide { OUTSIDE_LOWER, OUTSIDE_HIGHER };
  /** \brief The side that normals point to. Default: where values are lower. @{ */
  vtkSetClampMacro(Outside, int, OUTSIDE_LOWER, OUTSIDE_HIGHER);
  vtkGetMacro(Outside, int);
  /** @} */

  enum InterpolationKind {
    INTERPOLATION_LINEAR,
    INTERPOLATION_FIT,
    INTERPOLATION_SMOOTH = INTERPOLATION_FIT ///< the older name
  };
  /** \brief Isopoints along the edges, with normals by principal components of the 30
   * nearest, or on local polynomial fits (default). @{ */
  vtkSetClampMacro(Interpolation, int, INTERPOLATION_LINEAR, INTERPOLATION_FIT);
  vtkGetMacro(Interpolation, int);
  /** @} */

  enum AngleCriterionKind { CRITERION_KEPT, CRITERION_ALL };
  /** \brief Neighbours compared with kept closer ones (default) or with all. @{ */
  vtkSetClampMacro(AngleCriterion, int, CRITERION_KEPT, CRITERION_ALL);
  vtkGetMacro(AngleCriterion, int);
  /** @} */

  /** \brief Join the points to closed triangle meshes, see pcl_uvol::SurfaceMesh, with
   * the further arrays piece and cap; needs INTERPOLATION_FIT. Default: off. @{ */
  vtkSetMacro(Mesh, bool);
  vtkGetMacro(Mesh, bool);
  vtkBooleanMacro(Mesh, bool);
  /** @} */

  /** \brief Factors per axis of the space that distances are measured in: finite and
   * positive. Default 1, 1, 1. @{ */
  vtkSetVector3Macro(Scale, double);
  vtkGetVector3Macro(Scale, double);
  /** @} */

  /** \brief Predict samples between lines or sheets of samples by kriging, and extract
   * from both, see pcl_uvol::GapFilling: isopoints there have support 4, and all have
   * the further array confidence. A scale of 1, 1, 1 is then found from the field, see
   * pcl_uvol::chooseScale. Default: off. @{ */
  vtkSetMacro(FillGaps, bool);
  vtkGetMacro(FillGaps, bool);
  vtkBooleanMacro(FillGaps, bool);
  /** @} */

  /** \brief Smooth the surface by a level set with default parameters, see
   * pcl_uvol::LevelSetEvolution; vtkUvolLevelSet has all of them. Default: off. @{ */
  vtkSetMacro(Smooth, bool);
  vtkGetMacro(Smooth, bool);
  vtkBooleanMacro(Smooth, bool);
  /** @} */

  /** \brief Leave out points of a larger estimated error, or without an estimate, in
   * units of length; 0 (default): no bound. @{ */
  vtkSetClampMacro(MaximumError, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumError, double);
  /** @} */

  /** \brief Take the bound of the error from the samples instead: half of a point's
   * edge_length. Default: off. @{ */
  vtkSetMacro(AutomaticMaximumError, bool);
  vtkGetMacro(AutomaticMaximumError, bool);
  vtkBooleanMacro(AutomaticMaximumError, bool);
  /** @} */

  /** \brief Leave out points in gaps of the sampling: those of support 2. Default: off.
   * @{ */
  vtkSetMacro(DropBridged, bool);
  vtkGetMacro(DropBridged, bool);
  vtkBooleanMacro(DropBridged, bool);
  /** @} */

  /** \return The time of the last change, of the isovalues as well. */
  vtkMTimeType
  GetMTime() override;

protected:
  vtkUvolIsosurface();
  ~vtkUvolIsosurface() override;

  void
  Execute(pcl_uvol::FilterRun& run) override;

private:
  vtkUvolIsosurface(const vtkUvolIsosurface&) = delete;
  void
  operator=(const vtkUvolIsosurface&) = delete;

  /** Reads the input unless it is the one that was read last. */
  void
  ReadInput(vtkDataSet& input, const std::vector<int>& visible);

  vtkNew<vtkContourValues> Values;
  int ArrayComponent = 0;
  int Outside = OUTSIDE_LOWER;
  int Interpolation = INTERPOLATION_FIT;
  int AngleCriterion = CRITERION_KEPT;
  bool Mesh = false;
  double Scale[3] = {1.0, 1.0, 1.0};
  bool FillGaps = false;
  bool Smooth = false;
  double MaximumError = 0.0;
  bool AutomaticMaximumError = false;
  bool DropBridged = false;

  struct Samples;
  std::unique_ptr<Samples> Read; ///< with the tree
};
