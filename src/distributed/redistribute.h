// SPDX-License-Identifier: BSD-3-Clause
// Samples on their way to the processes that own their pieces.
#pragma once

#include <pcl_uvol/common/report.h>
#include <pcl_uvol/distributed/byte_stream.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/distributed/decomposition.h>
#include <pcl_uvol/distributed/samples.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Append samples to a message, and get them back from one: they join those that
 * are there. @{ */
void
putSamples(ByteWriter& writer, const Samples& samples);
void
getSamples(ByteReader& reader, Samples& samples);
/** @} */

/** \brief Send messages to all processes.
 * \param counter gets the bytes that leave this process \return those sent to it */
std::vector<Bytes>
send(std::vector<Bytes>&& messages,
     const std::string& counter,
     Communicator& communicator,
     Report& report);

/** \brief Which process owns a piece. */
class PieceOwners {
public:
  PieceOwners(std::size_t pieces, std::size_t ranks)
      : pieces_(pieces)
      , ranks_(ranks)
  {
  }

  std::size_t
  getOwner(std::size_t piece) const
  {
    return piece * ranks_ / pieces_;
  }

private:
  std::size_t pieces_, ranks_;
};

/** \brief Samples of some pieces. */
using SamplesOfPieces = std::map<std::size_t, Samples>;

/** \brief Part samples and send them to the owners of their pieces.
 * \param samples of this process; empty afterwards
 * \param report gets the time of "exchange" and the count "bytes_redistributed"
 * \return for each own piece its samples, in the order of the processes, this one first
 */
SamplesOfPieces
sendToOwners(Samples& samples,
             const Decomposition& decomposition,
             const PieceOwners& owners,
             Communicator& communicator,
             unsigned threads,
             Report& report);

} // namespace pcl_uvol
