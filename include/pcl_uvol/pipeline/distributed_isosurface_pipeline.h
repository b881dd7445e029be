// SPDX-License-Identifier: BSD-3-Clause
// IsosurfacePipeline for samples that many processes hold parts of.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <memory>

namespace pcl_uvol {

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
 * byte, but for normals: an isopoint without a fit has that of its edge, since
 * neighbours may lie on other processes. That goes for samples in a box that repeats as
 * well: each process gives the samples that it holds images, for whoever has those on
 * the other side. Memory: about 130 bytes per sample; in such a box a copy of all
 * fields besides. */
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

  /** \brief Run on all processes at once. Edges of the result are indices into what
   * they touch of the samples and their images, not into the input.
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
