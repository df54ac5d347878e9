// English, each text longer by 40 %, and said to be written from right to left: what another language would ask of the layouts.
#pragma once

#include <QRegularExpression>
#include <QTranslator>

#include <cmath>

namespace console::test {

class PseudoLanguage : public QTranslator {
public:
    using QTranslator::QTranslator;

    bool isEmpty() const override { return false; }

    QString translate(const char*, const char* source, const char*, int) const override
    {
        const QString text = QString::fromUtf8(source);
        if (text == QLatin1String("QT_LAYOUT_DIRECTION")) // by which Qt asks a language
            return QStringLiteral("RTL");
        // Numbers, units and names of keys are the same in every language.
        static const QRegularExpression same(QStringLiteral(
            "%\\d|\\d|\\b(mm/s|mm|ms|s|N|mL|mGy|Gy|min|kHz|MiB|KiB|MB|fps|px|PNG|DICOM|LiENa|F\\d+|Esc|cd|Hz)\\b|[^\\p{L}]"));
        QString letters = text;
        letters.remove(same);
        const auto more = qsizetype(std::ceil(0.4 * double(letters.size())));
        if (more == 0)
            return text;
        // Words of the length that words have, so that lines still break.
        constexpr qsizetype longestWord = 7;
        QString filler;
        const bool words = text.trimmed().contains(QLatin1Char(' '));
        for (qsizetype i = 0; i < more; ++i)
            filler += words && i % longestWord == 0 ? QLatin1Char(' ') : i % 2 == 0 ? QLatin1Char('o') : QLatin1Char('e');
        qsizetype end = text.size();
        while (end > 0 && text.at(end - 1).isSpace())
            --end;
        return text.left(end) + filler + text.mid(end);
    }
};

} // namespace console::test
