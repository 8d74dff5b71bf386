// Lets processes that work together meet, over VTK's MPI controller. All messages are sent and
// received on the pipeline's thread: MPI may be used by one thread only, and ParaView uses it
// there.
#include "RankTeam.h"

#include <vtkMultiProcessController.h>

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include <vtkMPIController.h>
#endif

#include <algorithm>
#include <array>
#include <chrono>
#include <deque>
#include <thread>

namespace smokevis
{
namespace
{

enum Message : int
{
  /// Has come to where parts are exchanged, and will exchange them when all others have.
  Ready,
  /// Was stopped while it waited there: the others should give up what they are doing.
  GiveUp,
  /// The last message of a process, which has done its part,
  Done,
  /// has failed, was stopped, or gives up because of another one.
  Failed,
  Stopped,
  Followed
};

/// How long to sleep when there is nothing to hear. Short against any step of the work.
constexpr std::chrono::microseconds Nap(200);
constexpr std::chrono::milliseconds Interval(50);

Error OthersProblem()
{
  return {"parallel run", "another process could not do its part", "Its message says why"};
}

Error Disagreement()
{
  return {"parallel run", "the processes do not agree on what to do next",
    "Run them on machines of one kind, with the same files"};
}

} // namespace

#if VTK_MODULE_ENABLE_VTK_ParallelMPI

//------------------------------------------------------------------------------
/// Messages between this process and all others.
struct RankTeam::Link
{
  /// Of this class alone among the users of the controller.
  static constexpr int Tag = 73911;
  /// Broadcasts count bytes in 32 bits.
  static constexpr std::size_t LargestPiece = std::size_t{1} << 28;

  struct Sent
  {
    std::array<int, 2> Words;
    vtkMPICommunicator::Request Request;
  };
  struct Peer
  {
    /// Codes of the meetings that it is ready for and that have not been held.
    std::deque<int> Ready;
    bool HasEnded = false;
    Message End = Done;
  };

  vtkMPIController* Controller;
  int Rank;
  std::vector<Peer> Peers;
  /// Messages must lie still until they have arrived.
  std::deque<Sent> Outbox;
  /// Whether another process has failed or was stopped.
  bool ShouldGiveUp = false;
  /// Whether this process has found out that it and the others do different things.
  bool Disagrees = false;

  explicit Link(vtkMPIController* controller)
      : Controller(controller), Rank(controller->GetLocalProcessId()),
        Peers(controller->GetNumberOfProcesses())
  {
  }

  static std::unique_ptr<Link> Make()
  {
    auto* const controller =
      vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
    return controller && controller->GetNumberOfProcesses() > 1 ? std::make_unique<Link>(controller)
                                                                : nullptr;
  }

  int Size() const { return static_cast<int>(this->Peers.size()); }

  /// @param code that all processes must send alike
  void Tell(Message message, int code = 0)
  {
    for (int rank = 0; rank < this->Size(); ++rank)
    {
      if (rank != this->Rank)
      {
        Sent& sent = this->Outbox.emplace_back();
        sent.Words = {message, code};
        this->Controller->NoBlockSend(sent.Words.data(), 2, rank, Tag, sent.Request);
      }
    }
  }

  /// Takes in what has arrived. What a process sends after its last message is for the next team.
  void Hear()
  {
    for (int rank = 0; rank < this->Size(); ++rank)
    {
      while (rank != this->Rank && !this->Peers[rank].HasEnded && this->HearOne(rank))
      {
      }
    }
  }

  bool HearOne(int rank)
  {
    int hasArrived = 0;
    this->Controller->Iprobe(rank, Tag, &hasArrived, nullptr);
    if (!hasArrived)
    {
      return false;
    }
    std::array<int, 2> words{};
    this->Controller->Receive(words.data(), 2, rank, Tag);
    Peer& peer = this->Peers[rank];
    if (words[0] == Ready)
    {
      peer.Ready.push_back(words[1]);
    }
    else if (words[0] == GiveUp)
    {
      this->ShouldGiveUp = true;
    }
    else
    {
      peer.HasEnded = true;
      peer.End = static_cast<Message>(words[0]);
      this->ShouldGiveUp = this->ShouldGiveUp || peer.End != Done;
    }
    return true;
  }

  template <class Condition> bool AllOthers(Condition&& condition) const
  {
    for (int rank = 0; rank < this->Size(); ++rank)
    {
      if (rank != this->Rank && !condition(this->Peers[rank]))
      {
        return false;
      }
    }
    return true;
  }

  bool AnyEnded(Message end) const
  {
    return !this->AllOthers([end](const Peer& peer) { return peer.End != end; });
  }

  /// Exchanges the parts when all processes have come so far. A process that has said that it is
  /// ready takes part if all others have said so too: they may be in the broadcast already.
  void Meet(const std::vector<Part>& parts, vtkAlgorithm& algorithm)
  {
    std::size_t code = parts.size();
    for (const Part& part : parts)
    {
      code = 31 * code + part.Bytes;
    }
    const auto own = static_cast<int>(code % 1000003);
    this->Tell(Ready, own);
    bool wasStopped = false;
    auto looked = std::chrono::steady_clock::now();
    for (this->Hear(); !this->AllOthers([](const Peer& peer) { return !peer.Ready.empty(); });
         this->Hear())
    {
      if (!this->AllOthers([](const Peer& peer) { return !peer.Ready.empty() || !peer.HasEnded; }))
      {
        throw this->ShouldGiveUp ? OthersProblem() : Disagreement();
      }
      std::this_thread::sleep_for(Nap);
      if (!wasStopped && std::chrono::steady_clock::now() - looked > Interval)
      {
        looked = std::chrono::steady_clock::now();
        wasStopped = algorithm.CheckAbort() != 0;
        if (wasStopped)
        {
          this->Tell(GiveUp);
        }
      }
    }
    bool agree = true;
    for (int rank = 0; rank < this->Size(); ++rank)
    {
      if (rank != this->Rank)
      {
        agree = agree && this->Peers[rank].Ready.front() == own;
        this->Peers[rank].Ready.pop_front();
      }
    }
    if (!agree)
    {
      this->Disagrees = true;
      throw Disagreement();
    }
    for (const Part& part : parts)
    {
      this->Broadcast(part);
    }
    if (wasStopped)
    {
      throw Error("the work", "it was stopped", "Update again to have it done");
    }
  }

  /// Waits until no process sends anything any more, and throws where any has not done its part.
  void Finish(vtkAlgorithm& algorithm, const std::exception_ptr& problem)
  {
    const bool isStopped = problem && algorithm.GetAbortOutput();
    const bool follows = problem && !isStopped && this->ShouldGiveUp && !this->Disagrees;
    this->Tell(!problem ? Done : isStopped ? Stopped : follows ? Followed : Failed);
    for (this->Hear(); !this->AllOthers([](const Peer& peer) { return peer.HasEnded; });
         this->Hear())
    {
      std::this_thread::sleep_for(Nap);
    }
    for (Sent& sent : this->Outbox)
    {
      sent.Request.Wait();
    }
    if (!problem && !this->ShouldGiveUp)
    {
      return;
    }
    // An abort is one only where nothing went wrong anywhere.
    const bool hasFailed = (problem && !isStopped && !follows) || this->AnyEnded(Failed);
    algorithm.SetAbortOutput(!hasFailed);
    if (problem && !follows)
    {
      std::rethrow_exception(problem);
    }
    throw OthersProblem();
  }

private:
  void Broadcast(const Part& part)
  {
    auto* const bytes = static_cast<char*>(part.Data);
    for (std::size_t first = 0; first < part.Bytes; first += LargestPiece)
    {
      const std::size_t count = std::min(LargestPiece, part.Bytes - first);
      this->Controller->Broadcast(bytes + first, static_cast<vtkIdType>(count), part.Owner);
    }
  }
};

#else

//------------------------------------------------------------------------------
/// Without MPI there is no other process.
struct RankTeam::Link
{
  int Rank = 0;

  static std::unique_ptr<Link> Make() { return nullptr; }
  int Size() const { return 1; }
  void Hear() {}
  void Meet(const std::vector<Part>&, vtkAlgorithm&) {}
  void Finish(vtkAlgorithm&, const std::exception_ptr&) {}

  bool ShouldGiveUp = false;
};

#endif

//------------------------------------------------------------------------------
RankTeam::RankTeam(vtkAlgorithm* algorithm) : Algorithm_(algorithm), Link_(Link::Make())
{
}

//------------------------------------------------------------------------------
RankTeam::~RankTeam() = default;

//------------------------------------------------------------------------------
int RankTeam::Rank() const
{
  return this->Link_ ? this->Link_->Rank : 0;
}

//------------------------------------------------------------------------------
int RankTeam::Size() const
{
  return this->Link_ ? this->Link_->Size() : 1;
}

//------------------------------------------------------------------------------
void RankTeam::Run(double begin, double end, const std::function<void(Progress&)>& work)
{
  if (!this->Link_)
  {
    RunWithProgress(this->Algorithm_, begin, end, work);
    return;
  }
  std::exception_ptr problem;
  try
  {
    RunWithProgress(
      this->Algorithm_, begin, end,
      [&](SharedProgress& progress)
      {
        this->Progress_ = &progress;
        work(progress);
        // Until all have done their part each of them can still be stopped.
        this->Share({});
      },
      [this]
      {
        this->Link_->Hear();
        return this->Link_->ShouldGiveUp;
      });
  }
  catch (...)
  {
    problem = std::current_exception();
  }
  this->Link_->Finish(*this->Algorithm_, problem);
}

//------------------------------------------------------------------------------
void RankTeam::Share(const std::vector<Part>& parts)
{
  if (!this->Link_)
  {
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  this->Progress_->OnCallersThread([&] { this->Link_->Meet(parts, *this->Algorithm_); });
  this->Waited_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace smokevis
