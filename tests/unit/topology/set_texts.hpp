// Message sets as short texts around the part that a test is about.
#pragma once

#include "marked_text.hpp"

#include "liena/message_set.hpp"

namespace liena::test {

inline constexpr auto setHead =
    "<message-set xmlns=\"urn:liena:message-set:1\" name=\"probe\" version=\"1\" class=\"hand\" manufacturer=\"1\" type=\"2\" "
    "device-version=\"3\">\n";

inline QByteArray inSet(const QByteArray& content) { return setHead + content + "\n</message-set>\n"; }

inline QByteArray inMessage(const QByteArray& fields,
                            const QByteArray& attributes = "number=\"0x0200\" role=\"report\" priority=\"status\"")
{
    return inSet(
        "<enum name=\"Mode\"><value name=\"off\" number=\"0\"/><value name=\"on\" number=\"1\"/></enum>\n<message name=\"Probe\" " +
        attributes + ">\n" + fields + "\n</message>");
}

inline QByteArray control(const QByteArray& more) { return "number=\"0x0101\" role=\"command\" priority=\"control\" " + more; }

/// The row's `xml` is refused with one error, at its mark, whose sentence holds the row's `fragment`.
inline void refusesMarkedSet()
{
    QFETCH(QByteArray, xml);
    QFETCH(QByteArray, fragment);
    const auto input = unmarked(xml.toStdString());
    QVERIFY2(input.line > 0, "the row has no mark");
    Findings findings;
    const auto set = MessageSet::parse(input.text, "set.xml", &findings);
    QVERIFY(!set);
    QVERIFY(set.error().code == Errc::MessageSetInvalid);
    QVERIFY2(holds(findings, Severity::Error, input, fragment.toStdString()), listed(findings).c_str());
    QVERIFY2(findings.size() == 1, listed(findings).c_str());
}

} // namespace liena::test
