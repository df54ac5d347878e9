// How far a picture is from what was asked for, in words.
#include "model/picture_reduction.hpp"

#include <QCoreApplication>

#include <cmath>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::PictureReduction)
};

QString number(double value) { return QString::number(std::round(value * 10) / 10); }

} // namespace

bool PictureReduction::losesInformation() const
{
    const bool lossless = encoding == PixelEncoding::Raw || (encoding == PixelEncoding::JpegLs && quality == 0);
    return stands() && (rate < askedRate || !lossless);
}

PictureReduction reductionOf(const XrayFrame& frame)
{
    if (frame.rung == 0)
        return {};
    return {frame.rung, frame.rate, frame.askedRate, frame.encoding, frame.quality};
}

QString rateWords(const PictureReduction& reduction)
{
    if (!reduction.stands())
        return {};
    const QString what = reduction.losesInformation() ? Text::tr("REDUCED") : Text::tr("RE-ENCODED");
    if (reduction.askedRate <= 0)
        return what;
    return Text::tr("%1 %2 of %3 /s").arg(what, number(reduction.rate), number(reduction.askedRate));
}

QString encodingWords(const PictureReduction& reduction)
{
    if (!reduction.stands())
        return {};
    switch (reduction.encoding) {
    case PixelEncoding::Raw:
        return Text::tr("raw");
    case PixelEncoding::JpegLs:
        return reduction.quality == 0 ? Text::tr("lossless") : Text::tr("lossy by at most %1").arg(reduction.quality);
    case PixelEncoding::Jpeg:
        return Text::tr("lossy %1").arg(reduction.quality);
    }
    return Text::tr("encoding %1").arg(static_cast<int>(reduction.encoding));
}

QString line(const PictureReduction& reduction)
{
    return reduction.stands() ? Text::tr("%1, %2").arg(rateWords(reduction), encodingWords(reduction)) : QString();
}

} // namespace console
