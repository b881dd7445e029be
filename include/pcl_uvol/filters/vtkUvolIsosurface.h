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
  static vtkUvolIsosurface*
  New();
  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief Isovalues in units of the array, as those of vtkContourFilter. Default:
   * one, 0.
   * \param i index of the isovalue, below GetNumberOfContours()
   * \param value in units of the array @{ */
  void
  SetValue(int i, double value)
  {
    this->Values->SetValue(i, value);
  }
  double
  GetValue(int i)
  {
    return this->Values->GetValue(i);
  }
  void
  SetNumberOfContours(int number)
  {
    this->Values->SetNumberOfContours(number);
  }
  int
  GetNumberOfContours()
  {
    return this->Values->GetNumberOfContours();
  }
  void
  GenerateValues(int number, double first, double last)
  {
    this->Values->GenerateValues(number, first, last);
  }
  /** @} */

  /** \brief The component of an array of several components, from 0; -1: their length.
   * Default 0. */
  vtkSetClampMacro(ArrayComponent, int, -1, VTK_INT_MAX);
  vtkGetMacro(ArrayComponent, int);

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

  struct Samples;
  std::unique_ptr<Samples> Read; ///< with the tree
};
