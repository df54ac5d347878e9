// The X-ray system as a device: its machine on a DistributedSystem, and a thread of its own that takes the pictures.
#pragma once

#include "frame_encoder.hpp"
#include "image_source.hpp"
#include "patient_side.hpp"
#include "viewer_paths.hpp"
#include "xray_machine.hpp"

#include "liena/distributed_system.hpp"

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace liena::devices {

struct XrayOptions {
    std::unique_ptr<ImageSource> source;
    Encoding encoding = Encoding::Raw;
    unsigned quality = 0;
    Reduction reduction = Reduction::Lossy;         ///< what may be done when the way to the viewers does not carry that
    std::function<std::vector<LinkStatus>()> links; ///< what takes DistributedSystem::links()'s place in tests

    /// Of the picture thread; what takes its place in tests may fail.
    std::function<Result<EncodedPicture>(FrameEncoder&, Picture&)> encode = [](FrameEncoder& encoder, Picture& picture) {
        return encoder.encode(picture);
    };
};

/// Made before the system starts, outlives its run. Commands, events and status are on the network thread; pictures are computed, encoded
/// and given to send() on the picture thread. The two share the machine and the view of the instruments under one mutex, held for moments
/// only.
class XrayDevice {
public:
    /// An error when the device of the topology is no X-ray system.
    static Result<std::unique_ptr<XrayDevice>> create(DistributedSystem& system, XrayOptions options, LogSink log);

    ~XrayDevice(); ///< ends the picture thread

    /// Any thread: a line typed by the person beside the X-ray system.
    void obey(std::string_view line) { m_patientSide.obey(line); }

private:
    struct Books {
        std::uint64_t acquired = 0;
        std::uint64_t sent = 0;
        std::uint64_t withheld = 0;
    };

    XrayDevice(DistributedSystem& system, XrayOptions options, LogSink log);

    Result<void> subscribe(bool robotLinked);
    void onAcquisition(const Message& message);
    void onGeometry(const Message& message);
    void onRobotStatus(const Message& message);
    void onEvent(const SessionEvent& event);
    void tick();
    void publishStatus();

    /// Network thread. Calls `use` with the machine under the mutex, then says what has changed: to the picture thread and the log whether
    /// the beam is on, to the others whether this device holds.
    template <typename Use>
    void withMachine(Use use);
    void endRun(std::string_view reason);
    void tellBeam(bool before, bool after, std::string_view reason);
    void tellHold(bool holds);

    void takePictures();
    void takeOne(std::unique_lock<std::mutex>& lock);
    bool chooseRung();
    void tellRung();
    bool produce(const Exposure& exposure, std::uint64_t frame);
    Message compose(const Exposure& exposure, std::uint64_t frame, const EncodedPicture& pixels, Timestamp captured) const;
    bool deliver(Message message);
    Result<EncodedPicture> encode(FrameEncoder& encoder, Picture& picture) const; ///< that a message holds
    void encodingFails(const std::string& what);
    void pictureFails(const std::string& what, std::string_view reason);
    void measure(const PictureRung& rung, std::size_t unencoded);
    void complain(const std::string& what);

    DistributedSystem& m_system;
    LogSink m_log;
    std::vector<DeviceId> m_viewers;
    PatientSide m_patientSide;
    std::string_view m_lastRefusal;
    std::optional<bool> m_confirmed; ///< what the others were told last

    std::mutex m_mutex; ///< of everything down to m_stopping
    std::condition_variable m_wake;
    XrayMachine m_machine;
    InstrumentView m_instruments;
    SteadyTime m_robotHeard;
    double m_contrastRemaining = 0;
    Books m_books;
    std::map<DeviceId, std::uint64_t> m_lost; ///< pictures accepted and lost, by viewer, since the last pulse
    bool m_stopping = false;

    // Of the picture thread.
    std::unique_ptr<ImageSource> m_source;
    FrameEncoder m_encoder;
    FrameEncoder m_measuring{Encoding::Raw, 0}; ///< of pictures that are not sent
    PictureLadder m_ladder;
    std::size_t m_mostBytes; ///< of an encoded picture
    ViewerPaths m_paths;
    std::function<std::vector<LinkStatus>()> m_links;
    std::function<Result<EncodedPicture>(FrameEncoder&, Picture&)> m_encode;
    double m_askedRate = 0;        ///< for the present pulse
    bool m_encodingFailed = false; ///< of the picture before
    bool m_saidLeftOut = false;    ///< that pulses are, since pictures take too long; once
    unsigned m_without = 0;        ///< pulses in a row whose picture could not be taken, or never be sent
    Picture m_picture;
    Picture m_spare;
    std::string m_lastComplaint;
    std::thread m_thread;
};

} // namespace liena::devices
