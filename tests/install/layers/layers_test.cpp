// No room knows more than the architecture allows, and this test would notice.
#include "layer_rules.hpp"

#include <QLibraryInfo>
#include <QTemporaryDir>
#include <QTest>

#include <fstream>

using namespace liena::test;

namespace {

std::filesystem::path qtCore() { return std::filesystem::path(QLibraryInfo::path(QLibraryInfo::HeadersPath).toStdString()) / "QtCore"; }

} // namespace

class LayersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyRoomKnowsOnlyWhatItMay();
    void findsQtCoresHeaders();
    void findsPlantedInclude_data();
    void findsPlantedInclude();
    void allows_data();
    void allows();
    void namesFileAndLineInATree();
};

void LayersTest::everyRoomKnowsOnlyWhatItMay()
{
    QVERIFY(sourcesOf(LIENA_SOURCE_DIR).size() > 20);
    std::string all;
    for (const auto& violation : checkTree(LIENA_SOURCE_DIR, qtCore()))
        all += "\n" + violation;
    QVERIFY2(all.empty(), all.c_str());
}

void LayersTest::findsQtCoresHeaders()
{
    QVERIFY(std::filesystem::exists(qtCore() / "QString"));
    QVERIFY(!std::filesystem::exists(qtCore() / "QColor"));
}

void LayersTest::findsPlantedInclude_data()
{
    QTest::addColumn<std::string>("file");
    QTest::addColumn<std::string>("line");
    QTest::addColumn<std::string>("words");
    const auto row = [](const char* file, const char* line, const char* words) {
        QTest::addRow("%s in %s", line, file) << std::string(file) << std::string(line) << std::string(words);
    };
    row("liena/src/session/a.cpp", "#include <boost/asio/ip/tcp.hpp>", "Asio is for");
    row("liena/src/session/a.cpp", "#include \"transport/tcp_channel.hpp\"", "session may know protocol, base");
    row("liena/src/session/a.cpp", "#include \"cache/queue.hpp\"", "session may know");
    row("liena/src/session/a.cpp", "#include \"liena/distributed_system.hpp\"", "for liena/src/system/ only");
    row("liena/src/protocol/a.cpp", "#include \"liena/message_cache.hpp\"", "for liena/src/cache/");
    row("liena/src/base/a.cpp", "#include \"protocol/header.hpp\"", "base may know nothing else");
    row("liena/src/base/log.cpp", "#include <openssl/sha.h>", "OpenSSL is for");
    row("liena/src/protocol/a.cpp", "  #  include <pugixml.hpp>", "pugixml is for");
    row("liena/src/topology/a.cpp", "#include \"session/machine.hpp\"", "topology may know");
    row("liena/src/security/a.cpp", "#include \"transport/tcp_channel.hpp\"", "security may know base");
    row("liena/src/transport/a.cpp", "#include \"tasks/reception.hpp\"", "transport may know");
    row("liena/src/tasks/a.cpp", "#include \"system/module.hpp\"", "tasks may know");
    row("liena/src/tasks/a.cpp", "#include \"topology/registry.hpp\"", "tasks may know");
    row("liena/src/base/a.cpp", "#include \"../protocol/header.hpp\"", "does not climb");
    row("liena/src/system/a.cpp", "#include <QString>", "Qt is for console/");
    row("liena/devices/a.cpp", "#include \"protocol/header.hpp\"", "only liena/");
    row("liena/devices/a.cpp", "#include <opencv2/core.hpp>", "OpenCV is for");
    row("liena/devices/a.cpp", "#include <boost/asio.hpp>", "Asio is for");
    row("liena/tools/a.cpp", "#include \"security/pem.hpp\"", "only liena/");
    row("liena/tools/a.cpp", "#include <QtCore/QString>", "Qt is for console/");
    row("liena/include/liena/a.hpp", "#include <openssl/ssl.h>", "OpenSSL is for");
    row("liena/include/liena/a.hpp", "#include <boost/asio/io_context.hpp>", "Asio is for");
    row("liena/include/liena/a.hpp", "#include <boost/circular_buffer.hpp>", "Boost.Outcome and");
    row("liena/include/liena/a.hpp", "#include <fmt/format.h>", "Boost.Outcome and");
    row("liena/include/liena/a.hpp", "#include \"protocol/header.hpp\"", "only liena/");
    row("console/model/a.hpp", "#include <QColor>", "Qt Core only");
    row("console/model/a.hpp", "#include <QtGui/QColor>", "Qt Core only");
    row("console/model/a.hpp", "#include \"link/session_link.hpp\"", "model may know nothing else");
    row("console/model/a.hpp", "#include \"liena/device_id.hpp\"", "only link/");
    row("console/app/a.cpp", "#include <liena/device_id.hpp>", "only link/");
    row("console/widgets/a.cpp", "#include \"link/session_link.hpp\"", "widgets may know");
    row("console/widgets/a.cpp", "#include <vtkNew.h>", "VTK is for");
    row("console/widgets/a.cpp", "#include <opencv2/core.hpp>", "OpenCV is for");
    row("console/imaging/a.cpp", "#include <charls/charls.h>", "CharLS is for liena/devices/");
    row("console/widgets/a.cpp", "#include <QMessageBox>", "A dialog, for which all else waits, is for nobody");
    row("console/editor/a.cpp", "#include <QtWidgets/QFileDialog>", "A dialog, for which all else waits, is for nobody");
    row("console/widgets/a.cpp", "#include <QAudioSink>", "Qt Multimedia is for console/sound/");
    row("console/app/cockpit_application.cpp", "#include <QDBusConnection>", "Qt D-Bus is for console/seat/");
    row("console/app/a.cpp", "#include <SDL.h>", "SDL is for console/input/");
    row("console/widgets/a.cpp", "#include <spnav.h>", "libspnav is for console/input/");
    row("console/sound/a.cpp", "#include \"app/alarm_sounder.hpp\"", "sound may know model");
    row("console/seat/a.cpp", "#include \"model/instant.hpp\"", "seat may know");
    row("console/watchdog/a.cpp", "#include \"app/watchdog_process.hpp\"", "watchdog may know sound, model");
    row("console/input/a.cpp", "#include \"widgets/theme.hpp\"", "input may know model");
    row("console/imaging/a.cpp", "#include \"widgets/theme.hpp\"", "imaging may know model");
    row("console/link/a.cpp", "#include \"app/main_window.hpp\"", "link may know model");
    row("console/link/a.cpp", "#include <boost/asio.hpp>", "Asio is for");
    row("console/editor/a.cpp", "#include \"link/system_link.hpp\"", "editor may know widgets, model");
}

void LayersTest::findsPlantedInclude()
{
    QFETCH(std::string, file);
    QFETCH(std::string, line);
    QFETCH(std::string, words);
    const auto violations = checkIncludes(file, "// first\n#include <vector>\n" + line + "\n", qtCore());
    QCOMPARE(violations.size(), std::size_t(1));
    QVERIFY2(violations.front().starts_with(file + ":3: includes "), violations.front().c_str());
    QVERIFY2(violations.front().find(words) != std::string::npos, violations.front().c_str());
}

void LayersTest::allows_data()
{
    QTest::addColumn<std::string>("file");
    QTest::addColumn<std::string>("line");
    const auto row = [](const char* file, const char* line) {
        QTest::addRow("%s in %s", line, file) << std::string(file) << std::string(line);
    };
    row("liena/src/base/hash.cpp", "#include <openssl/sha.h>");
    row("liena/src/system/a.cpp", "#include \"liena/distributed_system.hpp\"");
    row("liena/src/system/a.cpp", "#include \"base/bytes.hpp\"");
    row("liena/src/tasks/a.cpp", "#include <boost/asio/steady_timer.hpp>");
    row("liena/src/topology/a.cpp", "#include <pugixml.hpp>");
    row("liena/src/session/a.cpp", "#include \"session/instant.hpp\"");
    row("liena/include/liena/error.hpp", "#include <boost/outcome/basic_result.hpp>");
    row("liena/include/liena/message.hpp", "#include <boost/container/small_vector.hpp>");
    row("liena/devices/a.cpp", "#include \"liena/distributed_system.hpp\"");
    row("liena/devices/a.cpp", "#include \"drive_gate.hpp\"");
    row("console/model/a.hpp", "#include <QString>");
    row("console/link/a.cpp", "#include \"liena/distributed_system.hpp\"");
    row("console/app/a.cpp", "#include \"link/session_link.hpp\"");
    row("console/seat/a.cpp", "#include <QDBusArgument>");
    row("console/imaging/a.cpp", "#include <vtkNew.h>");
    row("console/model/a.hpp", "// #include <QColor>");
}

void LayersTest::allows()
{
    QFETCH(std::string, file);
    QFETCH(std::string, line);
    const auto violations = checkIncludes(file, line, qtCore());
    QVERIFY2(violations.empty(), violations.empty() ? "" : violations.front().c_str());
}

void LayersTest::namesFileAndLineInATree()
{
    const QTemporaryDir folder;
    const auto tree = std::filesystem::path(folder.path().toStdString());
    std::filesystem::create_directories(tree / "liena/src/cache/deeper");
    std::filesystem::create_directories(tree / "console");
    std::ofstream(tree / "liena/src/cache/deeper/queue.hpp") << "// Queue.\n#pragma once\n\n#include \"system/module.hpp\"\n";
    std::ofstream(tree / "liena/src/cache/notes.txt") << "#include \"system/module.hpp\"\n";
    QCOMPARE(checkTree(tree, qtCore()),
             Violations{"liena/src/cache/deeper/queue.hpp:4: includes system/module.hpp, but cache may know protocol, base"});
}

QTEST_GUILESS_MAIN(LayersTest)
#include "layers_test.moc"
