// Where a picture's age comes from.
#include "model/picture_stages.hpp"

#include "model/measurements.hpp"

#include <QCoreApplication>

#include <numeric>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::PictureStages)
};

} // namespace

QString word(PictureStage stage)
{
    switch (stage) {
    case PictureStage::Sending:
        return Text::tr("before sending");
    case PictureStage::Way:
        return Text::tr("way to here");
    case PictureStage::Waiting:
        return Text::tr("waiting");
    case PictureStage::Decoding:
        return Text::tr("decoding");
    case PictureStage::Filters:
        return Text::tr("filters");
    case PictureStage::Window:
        return Text::tr("window");
    case PictureStage::FilterDelay:
        return Text::tr("filter's delay");
    }
    return {};
}

void PictureStages::note(const StageShares& shares, Instant painted)
{
    m_painted.push_back({painted, shares, std::nullopt});
    while (m_painted.size() > mostPictures || m_painted.front().at < painted - span)
        m_painted.pop_front();
}

void PictureStages::notePresented(Duration presenting)
{
    if (!m_painted.empty())
        m_painted.back().presenting = presenting;
}

template <typename Value>
std::optional<PictureStages::Summary> PictureStages::summary(Instant now, Value value) const
{
    std::vector<double> values;
    for (const auto& picture : m_painted)
        if (const std::optional<Duration> known = value(picture); known && picture.at >= now - span)
            values.push_back(milliseconds(*known));
    if (values.empty())
        return std::nullopt;
    return Summary{*percentile(values, 0.5), *percentile(values, 0.99)};
}

std::optional<PictureStages::Summary> PictureStages::of(PictureStage stage, Instant now) const
{
    return summary(now, [stage](const Painted& picture) { return std::optional(picture.shares.at(static_cast<std::size_t>(stage))); });
}

std::optional<PictureStages::Summary> PictureStages::ofAge(Instant now) const
{
    return summary(now, [](const Painted& picture) {
        return std::optional(std::accumulate(picture.shares.begin(), picture.shares.end(), Duration::zero()));
    });
}

std::optional<PictureStages::Summary> PictureStages::ofPresenting(Instant now) const
{
    return summary(now, [](const Painted& picture) { return picture.presenting; });
}

} // namespace console
