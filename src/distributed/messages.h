// SPDX-License-Identifier: BSD-3-Clause
// What processes send each other of their samples, and how much it is.
#pragma once

#include "distributed/byte_stream.h"
#include "distributed/samples.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Append samples to a message. */
void
putSamples(ByteWriter& writer, const SampleSpan& samples);

/** \brief Append samples of a message to others. */
void
getSamples(ByteReader& reader, Samples& samples);

/** \brief The bytes that putSamples appends. */
std::size_t
countBytes(const SampleSpan& samples);

/** \brief Send messages to all processes.
 * \param counter gets the bytes that leave this process
 * \return those sent to it */
std::vector<Bytes>
send(std::vector<Bytes>&& messages,
     const std::string& counter,
     Communicator& communicator,
     Report& report);

} // namespace pcl_uvol
