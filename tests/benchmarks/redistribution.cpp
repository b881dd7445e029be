// SPDX-License-Identifier: BSD-3-Clause
// What it takes to redistribute samples in one step and in two, by mpirun. Time that
// processes spend by themselves is measured apart from that in which they communicate,
// so that it means something where they share cores.
// usage: redistribution SAMPLES_PER_PROCESS LEVELS GROUPS...
#include "common/random.h"
#include "distributed/redistribute.h"
#include <pcl_uvol/mpi/mpi_communicator.h>

#include <vtkMPIController.h>
#include <vtkNew.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace {

using pcl_uvol::Bytes;
using pcl_uvol::Communicator;

/** Seconds of the processor, of this process. */
double
cpuTime()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/** What a process communicates. */
struct Traffic {
  double seconds = 0.0; ///< of the processor
  std::uint64_t calls = 0, messages = 0;
};

/** Keeps account of another communicator, and of its groups. */
class Account : public Communicator {
public:
  Account(Communicator& communicator, Traffic& traffic)
      : communicator_(communicator)
      , traffic_(traffic)
  {
  }

  Account(std::unique_ptr<Communicator> communicator, Traffic& traffic)
      : owned_(std::move(communicator))
      , communicator_(*owned_)
      , traffic_(traffic)
  {
  }

  std::size_t
  size() const override
  {
    return communicator_.size();
  }
  std::size_t
  rank() const override
  {
    return communicator_.rank();
  }
  void
  allReduce(std::vector<std::uint64_t>& numbers) override
  {
    keep([&] { communicator_.allReduce(numbers); });
  }
  std::vector<Bytes>
  allToAll(std::vector<Bytes>&& messages) override
  {
    for (const Bytes& message : messages)
      traffic_.messages += message.empty() ? 1 : 2; // its length, and its content
    std::vector<Bytes> received;
    keep([&] { received = communicator_.allToAll(std::move(messages)); });
    return received;
  }
  std::vector<Bytes>
  allGather(const Bytes& message) override
  {
    std::vector<Bytes> received;
    keep([&] { received = communicator_.allGather(message); });
    return received;
  }
  std::unique_ptr<Communicator>
  split(std::size_t color) override
  {
    std::unique_ptr<Communicator> group;
    keep([&] { group = communicator_.split(color); });
    return std::make_unique<Account>(std::move(group), traffic_);
  }

private:
  template <typename Work>
  void
  keep(const Work& work)
  {
    const double start = cpuTime();
    work();
    traffic_.seconds += cpuTime() - start;
    ++traffic_.calls;
  }

  std::unique_ptr<Communicator> owned_;
  Communicator& communicator_;
  Traffic& traffic_;
};

pcl_uvol::Samples
makeSamples(std::size_t count, std::size_t rank)
{
  pcl_uvol::Samples samples;
  samples.reserve(count);
  for (std::size_t i = rank * count; i < (rank + 1) * count; ++i) {
    const auto at = [&](std::uint64_t axis) {
      return static_cast<float>(pcl_uvol::uniformAt(3, i, axis));
    };
    samples.push({{at(0), at(1), at(2)}}, at(3), i);
  }
  return samples;
}

/** The sum over processes, in microseconds as MPI adds whole numbers. */
double
addUp(double seconds, Communicator& communicator)
{
  std::vector<std::uint64_t> sum{static_cast<std::uint64_t>(1e6 * seconds)};
  communicator.allReduce(sum);
  return 1e-6 * static_cast<double>(sum[0]);
}

void
measure(std::size_t count, int levels, std::size_t groups, Communicator& communicator)
{
  pcl_uvol::Samples samples = makeSamples(count, communicator.rank());
  Traffic traffic;
  Account account(communicator, traffic);
  pcl_uvol::Report report;
  communicator.barrier();
  const double start = cpuTime();
  const auto parted =
      redistribute(std::move(samples), levels, groups, account, 1, report);
  const double alone = cpuTime() - start - traffic.seconds;
  const auto ranks = static_cast<double>(communicator.size());
  const double work = addUp(alone, communicator) / ranks;
  const double talk = addUp(traffic.seconds, communicator) / ranks;
  const auto sent = 1e-6 * static_cast<double>(report.getCount("bytes_redistributed"));
  if (communicator.rank() == 0)
    std::printf("%6zu %9.1f %11.3f %7lu %9lu %8.1f\n",
                groups,
                1e9 * work / static_cast<double>(count),
                talk,
                static_cast<unsigned long>(traffic.calls),
                static_cast<unsigned long>(traffic.messages),
                sent);
}

} // namespace

int
main(int argc, char** argv)
{
  const vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  if (argc >= 4) {
    pcl_uvol::MpiCommunicator communicator(*controller);
    if (communicator.rank() == 0)
      std::printf("groups ns/sample communicate   calls  messages MB sent\n");
    for (int i = 3; i < argc; ++i)
      measure(
          std::stoul(argv[1]), std::stoi(argv[2]), std::stoul(argv[i]), communicator);
  }
  controller->Finalize();
  return argc >= 4 ? 0 : 2;
}
