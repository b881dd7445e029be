// SPDX-License-Identifier: BSD-3-Clause
// From samples to an isosurface with normals and all fields: the one way that the
// tools, the viewer and the filters take, in one process or in many.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <pcl/pcl_base.h>

#include <memory>
#include <optional>

namespace pcl_uvol {

/** \brief Extraction, level set, normals, filters and fields in one call.
 *
 * \code
 * pcl_uvol::IsosurfacePipeline pipeline;
 * pipeline.setInput(dataset); // a std::shared_ptr<const pcl_uvol::Dataset>
 * pcl_uvol::IsosurfacePipelineParameters parameters;
 * parameters.isosurface.isovalues = {0.5};
 * parameters.smooth = true;
 * pipeline.setParameters(parameters);
 * const pcl_uvol::IsosurfaceResult result = pipeline.run();
 * \endcode
 * Without `smooth` the tree is built once per input: further isovalues and fields reuse
 * it. */
class PCL_UVOL_EXPORTS IsosurfacePipeline
    : public ParameterStage<IsosurfacePipelineParameters> {
public:
  using Ptr = std::shared_ptr<IsosurfacePipeline>;
  using ConstPtr = std::shared_ptr<const IsosurfacePipeline>;

  /** \brief The samples. Values and tree are kept until the samples change, in place or
   * by another call: see IsosurfaceExtraction::setInputCloud. */
  void
  setInput(const std::shared_ptr<const Dataset>& samples);

  /** \return The samples; null before they are set. */
  const std::shared_ptr<const Dataset>&
  getInput() const
  {
    return samples_;
  }

  /** \brief The samples to take; null, the default: all of them. */
  void
  setIndices(const pcl::IndicesPtr& indices);

  /** \return The samples to take; null: all of them. */
  const pcl::IndicesPtr&
  getIndices() const
  {
    return indices_;
  }

  /** \brief Run from the samples to the surface; getReport() is that of the result.
   * \throws InvalidArgument without an input, for a field of names, for more samples
   * than memory has room for, as checkParameters, and as the stages do
   * \throws Diverged as LevelSetEvolution */
  IsosurfaceResult
  run();

  /** \brief The field and the scale that run() takes: those of the parameters, with the
   * automatic ones filled in.
   * \param choice where it is not null, how an automatic scale was found; else as it is
   * \throws InvalidArgument without an input, if the field is not given and not unique,
   * and as chooseScale */
  IsosurfaceParameters
  resolveParameters(std::optional<ScaleChoice>* choice = nullptr) const;

  /** \brief Bytes that run() will take besides its input, about: enough for surfaces of
   * usual size, such as spheres.
   * \throws InvalidArgument without an input */
  double
  estimateMemory() const;

private:
  std::shared_ptr<const Dataset> samples_;
  pcl::IndicesPtr indices_;
  IsosurfaceExtraction<pcl::PCLPointCloud2> extraction_;
};

/** \brief Extraction, filters and fields in one call, which all processes make.
 *
 * \code
 * pcl_uvol::MpiCommunicator communicator(*controller);
 * pcl_uvol::DistributedIsosurfacePipeline pipeline(communicator);
 * pipeline.setInput(part); // the samples of this process
 * pipeline.setParameters(parameters);
 * const pcl_uvol::IsosurfaceResult result = pipeline.run();
 * \endcode
 * The isopoints of all processes together are those of IsosurfacePipeline, byte for
 * byte, except for normals: an isopoint without a fit has the normal of its edge,
 * because neighbours may be on other processes. This includes periodic boxes: each
 * process adds images of its samples for the processes that have the samples on the
 * other side. Memory: about 130 bytes per sample; in a periodic box also a copy of all
 * fields. */
class PCL_UVOL_EXPORTS DistributedIsosurfacePipeline
    : public ParameterStage<IsosurfacePipelineParameters> {
public:
  using Ptr = std::shared_ptr<DistributedIsosurfacePipeline>;
  using ConstPtr = std::shared_ptr<const DistributedIsosurfacePipeline>;

  /** \param communicator must outlive the pipeline */
  explicit DistributedIsosurfacePipeline(Communicator& communicator)
      : communicator_(communicator)
  {
  }

  /** \brief The samples of this process, of the same fields and the same origin on all
   * of them; there may be none. */
  void
  setInput(const std::shared_ptr<const Dataset>& part)
  {
    part_ = part;
  }

  /** \return The samples of this process; null before they are set. */
  const std::shared_ptr<const Dataset>&
  getInput() const
  {
    return part_;
  }

  /** \brief True: the first process gets the whole surface, in the order in which
   * IsosurfacePipeline gives it, and the others nothing. False, the default: each
   * process keeps the isopoints of its piece of space, ordered by their edges. */
  void
  setGathered(bool is_gathered)
  {
    is_gathered_ = is_gathered;
  }

  /** \return Whether the first process gets the whole surface. */
  bool
  isGathered() const
  {
    return is_gathered_;
  }

  /** \brief Run on all processes at once. Edges of the result are indices into the
   * samples that they touch, and images of these, not into the input.
   * \throws InvalidArgument as IsosurfacePipeline, for an automatic scale, a level set
   * and normals other than those of fits and edges; on all processes if there is no
   * sample at all */
  IsosurfaceResult
  run();

private:
  Communicator& communicator_;
  std::shared_ptr<const Dataset> part_;
  bool is_gathered_ = false;
};

} // namespace pcl_uvol
