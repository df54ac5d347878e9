// The matrix of certificates over real sockets, against a device in session: exactly one row opens.
#include "hostile_stage.hpp"
#include "support/certificate_matrix.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

/// The row's files, as the scripted X-ray system would show them.
TlsFace faceOf(const CertificateRow& row, HostileStage& stage, const MatrixSigners& signers)
{
    TlsFace face{.certificate = {}, .key = {}, .authority = stage.system.identityOf("xray").authority, .between = {}, .alpn = row.alpn};
    face.highestVersion = row.highestVersion;
    face.groups = row.groups;
    if (!row.showsCertificate)
        return face;
    face.certificate = stage.system.folder() / "row.crt";
    face.key = stage.system.folder() / "row.key";
    signers.made(row).writeTo(face.certificate, face.key);
    return face;
}

MatrixSigners signersOf(HostileStage& stage) { return {stage.system.authority().certificate(), stage.system.authority().key()}; }

} // namespace

class HostileCertificatesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void opensExactlyOneRowOfThoseWhoAsk()
    {
        HostileStage stage;
        const auto signers = signersOf(stage);
        const auto rows = certificateMatrix(stage.xrayId, stage.armId);
        QVERIFY(rows.size() >= 40);
        std::vector<std::string> opened;
        for (const auto& row : rows) {
            const auto changes = stage.robot.events(Kind::StateChanged, stage.xrayId).size();
            stage.peer.show(faceOf(row, stage, signers));
            const auto link = stage.peer.saying(stage.peer.attach(4711));
            if (row.serverSays[0] != '\0') {
                // A TLS 1.3 client may think that it is through, and hears of the refusal only then.
                QVERIFY2(!link->failure().empty() || link->closes(), row.name);
                QVERIFY2(stage.robot.events(Kind::StateChanged, stage.xrayId).size() == changes, row.name);
            }
            const auto refused = !link->failure().empty() ? std::optional<std::uint8_t>(0) : stage.peer.refusalOfConnecting();
            if (!refused)
                opened.push_back(row.name);
        }
        QCOMPARE(opened, std::vector<std::string>{"as it should be"});
        QVERIFY2(stage.robot.heard(Kind::Opened, stage.xrayId), stage.story().c_str());
        QVERIFY2(!stage.refusals().empty(), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void opensExactlyOneRowOfThoseItAsks()
    {
        HostileStage stage;
        const auto signers = signersOf(stage);
        std::vector<std::string> opened;
        for (const auto& row : certificateMatrix(stage.xrayId, stage.armId)) {
            if (!row.showsCertificate || row.highestVersion != TLS1_3_VERSION || row.alpn != "liena/1")
                continue; // of those who ask
            stage.peer.show(faceOf(row, stage, signers));
            const auto failures = stage.robot.events(Kind::OpenFailed, stage.xrayId).size();
            QVERIFY(stage.robot->openChannel(stage.xrayId));
            QVERIFY2(eventually([&] {
                         return stage.robot.events(Kind::OpenFailed, stage.xrayId).size() > failures ||
                                stage.robot.heard(Kind::Opened, stage.xrayId);
                     }),
                     row.name);
            if (stage.robot.heard(Kind::Opened, stage.xrayId)) {
                opened.push_back(row.name);
                break;
            }
            const auto failed = stage.robot.events(Kind::OpenFailed, stage.xrayId).back();
            QVERIFY2(failed.diagnosis.probe == ProbeResult::TlsFailure, (row.name + (": " + failed.detail)).c_str());
            const auto says = [&](const std::string& words) { return failed.detail.find(words) != std::string::npos; };
            QVERIFY2(says(row.clientSays) || says("is device " + stage.armId.toString()), (row.name + (": " + failed.detail)).c_str());
        }
        QCOMPARE(opened, std::vector<std::string>{"as it should be"});
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileCertificatesTest)
#include "hostile_certificates_test.moc"
