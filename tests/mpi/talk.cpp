// SPDX-License-Identifier: BSD-3-Clause
// Processes that exchange messages whose bytes each can foretell; run by mpirun from
// test_mpi_communicator. usage: talk PARTS [LOSER FUNCTION]: the largest part of a
// message; the process that fails while the others call allReduce, allGather or
// allToAll, or are in a group.
#include <pcl_uvol/mpi/mpi_communicator.h>

#include <vtkMPIController.h>
#include <vtkNew.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

using pcl_uvol::Bytes;
using pcl_uvol::MpiCommunicator;

/** Some are empty, some have many parts. */
Bytes
makeMessage(std::size_t from, std::size_t to, std::size_t round)
{
  Bytes message((from * 7 + to * 3 + round) % 5 * 1000 * (round + 1));
  for (std::size_t i = 0; i < message.size(); ++i)
    message[i] = static_cast<std::uint8_t>(i * i + from * 31 + to * 17 + round);
  return message;
}

/** In groups by the remainder of the rank, all at once.
 * \return what is wrong */
std::string
talkInGroups(MpiCommunicator& communicator, std::size_t groups)
{
  const std::size_t color = communicator.rank() % groups;
  const auto group = communicator.split(color);
  std::vector<std::size_t> members;
  for (std::size_t rank = color; rank < communicator.size(); rank += groups)
    members.push_back(rank);
  if (group->size() != members.size() ||
      members.at(group->rank()) != communicator.rank())
    return "a group has other processes";
  // Groups do not talk equally often.
  for (std::size_t round = 0; round <= color; ++round) {
    std::vector<Bytes> messages;
    messages.reserve(members.size());
    for (const std::size_t to : members)
      messages.push_back(makeMessage(communicator.rank(), to, round));
    const auto received = group->allToAll(std::move(messages));
    for (std::size_t i = 0; i < members.size(); ++i)
      if (received.at(i) != makeMessage(members[i], communicator.rank(), round))
        return "a message in a group differs";
    std::vector<std::uint64_t> number{1};
    group->allReduce(number);
    if (number[0] != members.size())
      return "a sum in a group differs";
  }
  return "";
}

/** \return what is wrong */
std::string
talk(MpiCommunicator& communicator)
{
  for (std::size_t round = 0; round < 5; ++round) {
    std::vector<Bytes> messages;
    for (std::size_t to = 0; to < communicator.size(); ++to)
      messages.push_back(makeMessage(communicator.rank(), to, round));
    const auto received = communicator.allToAll(std::move(messages));
    for (std::size_t from = 0; from < communicator.size(); ++from)
      if (received.at(from) != makeMessage(from, communicator.rank(), round))
        return "a message differs";
    const auto gathered =
        communicator.allGather(makeMessage(communicator.rank(), 0, round));
    for (std::size_t from = 0; from < communicator.size(); ++from)
      if (gathered.at(from) != makeMessage(from, 0, round))
        return "a gathered message differs";
    std::vector<std::uint64_t> numbers{
        communicator.rank(), std::uint64_t(1) << 40, round};
    communicator.allReduce(numbers);
    const std::uint64_t n = communicator.size();
    if (numbers != std::vector<std::uint64_t>{n * (n - 1) / 2, n << 40, n * round})
      return "a sum differs";
  }
  communicator.barrier();
  for (const std::size_t groups : {1, 2, 3})
    if (std::string complaint = talkInGroups(communicator, groups); !complaint.empty())
      return complaint;
  return "";
}

/** One process fails within its group.
 * \return what is wrong */
std::string
failInGroup(MpiCommunicator& communicator, std::size_t loser)
{
  try {
    const auto group = communicator.split(communicator.rank() % 2);
    if (communicator.rank() == loser)
      throw std::runtime_error("lost");
    group->barrier();
    if (communicator.rank() % 2 == loser % 2)
      return "nobody failed in the group";
    communicator.barrier();
    return "nobody failed";
  }
  catch (const std::exception&) {
    return communicator.agree(false) == loser ? "" : "the loser is another one";
  }
}

/** \return what is wrong */
std::string
fail(MpiCommunicator& communicator, std::size_t loser, const std::string& function)
{
  if (function == "group")
    return failInGroup(communicator, loser);
  if (communicator.rank() >= loser) // the first one counts
    return communicator.agree(true) == loser ? "" : "the loser is another one";
  try {
    std::vector<std::uint64_t> numbers{1};
    if (function == "allReduce")
      communicator.allReduce(numbers);
    else if (function == "allGather")
      communicator.allGather(Bytes(10));
    else
      communicator.allToAll(std::vector<Bytes>(communicator.size(), Bytes(10)));
  }
  catch (const pcl_uvol::OtherRankFailed&) {
    return communicator.agree(false) == loser ? "" : "the loser is forgotten";
  }
  return "nobody failed";
}

} // namespace

int
main(int argc, char** argv)
{
  const vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  std::string complaint;
  {
    MpiCommunicator communicator(*controller, std::stoul(argv[1]));
    complaint = talk(communicator);
    if (complaint.empty() && argc == 4)
      complaint = fail(communicator, std::stoul(argv[2]), argv[3]);
    std::cout << "process " << communicator.rank() << " of " << communicator.size()
              << '\n';
  }
  controller->Finalize();
  if (!complaint.empty())
    std::cerr << complaint << '\n';
  return complaint.empty() ? 0 : 1;
}
