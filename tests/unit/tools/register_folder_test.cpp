// Which register a command reads when none was named.
#include "register_folder.hpp"

#include <QTemporaryDir>
#include <QTest>

#include <filesystem>
#include <memory>

using namespace liena::tools;

class RegisterFolderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_scratch = std::make_unique<QTemporaryDir>();
        QVERIFY(m_scratch->isValid());
        const std::filesystem::path root = m_scratch->path().toStdString();
        m_working = root / "work";
        m_program = root / "prefix/bin/liena";
        m_installed = root / "prefix/share/liena/devices";
    }

    void takesTheProjectsBeforeTheInstalledOne()
    {
        std::filesystem::create_directories(m_working / "resources/devices");
        std::filesystem::create_directories(m_installed);
        QCOMPARE(registerFolder(m_working, m_program), m_working / "resources/devices");
    }

    void takesTheInstalledOneElsewhere()
    {
        std::filesystem::create_directories(m_installed);
        QCOMPARE(registerFolder(m_working, m_program), m_installed);
    }

    void namesTheProjectsWhereThereIsNone()
    {
        QCOMPARE(registerFolder(m_working, m_program), m_working / "resources/devices");
        QCOMPARE(registerFolder({}, {}), std::filesystem::path("resources/devices"));
    }

private:
    std::unique_ptr<QTemporaryDir> m_scratch;
    std::filesystem::path m_working;
    std::filesystem::path m_program;
    std::filesystem::path m_installed;
};

QTEST_GUILESS_MAIN(RegisterFolderTest)
#include "register_folder_test.moc"
