// What certificates say, as the rest of the library is told it.
#include "security/certificate_fields.hpp"

#include <QTest>

#include <memory>

using namespace liena::security;
using namespace std::chrono_literals;

class CertificateFieldsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void readsDates_data();
    void readsDates();
    void cutsDatesThatTheClockCannotHold_data();
    void cutsDatesThatTheClockCannotHold();
};

namespace {

std::chrono::system_clock::time_point read(const QByteArray& text)
{
    const std::unique_ptr<ASN1_TIME, decltype(&ASN1_TIME_free)> time(ASN1_TIME_new(), ASN1_TIME_free);
    return ASN1_TIME_set_string(time.get(), text.constData()) == 1 ? timeOf(time.get()) : std::chrono::system_clock::time_point();
}

} // namespace

void CertificateFieldsTest::readsDates_data()
{
    QTest::addColumn<QByteArray>("asn1");
    QTest::addColumn<QString>("text");
    QTest::newRow("two digits") << QByteArray("260101000000Z") << "2026-01-01 00:00 UTC";
    QTest::newRow("four digits") << QByteArray("20611231235959Z") << "2061-12-31 23:59 UTC";
}

void CertificateFieldsTest::readsDates()
{
    QFETCH(QByteArray, asn1);
    QTEST(QString::fromStdString(dateText(read(asn1))), "text");
}

void CertificateFieldsTest::cutsDatesThatTheClockCannotHold_data()
{
    QTest::addColumn<QByteArray>("asn1");
    QTest::addColumn<bool>("isAhead");
    QTest::newRow("no well-defined end") << QByteArray("99991231235959Z") << true;
    QTest::newRow("after 2262") << QByteArray("22630101000000Z") << true;
    QTest::newRow("before 1970") << QByteArray("19691231235959Z") << false;
    QTest::newRow("year 1") << QByteArray("00010101000000Z") << false;
}

void CertificateFieldsTest::cutsDatesThatTheClockCannotHold()
{
    QFETCH(QByteArray, asn1);
    QFETCH(bool, isAhead);
    const auto now = std::chrono::system_clock::now();
    const auto left = read(asn1) - now; // what asks whether a certificate ends within a day
    QCOMPARE(left > 24h, isAhead);
    QVERIFY(!isAhead || left > 24h * 365 * 100);
}

QTEST_GUILESS_MAIN(CertificateFieldsTest)
#include "certificate_fields_test.moc"
