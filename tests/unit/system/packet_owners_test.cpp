// Packets find their session: whoever has the token now, remembered or not.
#include "system/packet_owners.hpp"

#include <QTest>

#include <map>
#include <memory>
#include <utility>

using namespace liena::system;

namespace {

struct Owner {
    std::uint64_t token = 0;
    mutable int asked = 0;

    bool owns(std::uint64_t wanted) const
    {
        ++asked;
        return wanted != 0 && wanted == token;
    }
};

using Owners = std::map<int, std::unique_ptr<Owner>>;

Owners ownersOf(std::initializer_list<std::uint64_t> tokens)
{
    Owners owners;
    for (const auto token : tokens)
        owners.emplace(static_cast<int>(owners.size()), std::make_unique<Owner>(Owner{token}));
    return owners;
}

int asked(const Owners& owners)
{
    int sum = 0;
    for (const auto& [place, owner] : owners)
        sum += std::exchange(owner->asked, 0);
    return sum;
}

} // namespace

class PacketOwnersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void asksAllOnceAndThenOnlyTheOwner()
    {
        const auto owners = ownersOf({11, 22, 33, 44});
        PacketOwners<Owner> index;
        QCOMPARE(index.find(44, owners), owners.at(3).get());
        QCOMPARE(asked(owners), 4);
        QCOMPARE(index.find(44, owners), owners.at(3).get());
        QCOMPARE(asked(owners), 1);
    }

    void followsATokenToItsNewOwner()
    {
        const auto owners = ownersOf({11, 22});
        PacketOwners<Owner> index;
        QCOMPARE(index.find(11, owners), owners.at(0).get());
        owners.at(0)->token = 33;
        QCOMPARE(index.find(11, owners), nullptr);
        owners.at(1)->token = 11;
        QCOMPARE(index.find(11, owners), owners.at(1).get());
        QCOMPARE(index.find(33, owners), owners.at(0).get());
    }

    void strangersLeaveNothingBehind()
    {
        const auto owners = ownersOf({11, 0});
        PacketOwners<Owner> index;
        for (std::uint64_t token = 100; token < 200; ++token)
            QCOMPARE(index.find(token, owners), nullptr);
        QCOMPARE(index.find(0, owners), nullptr);
        QCOMPARE(index.size(), std::size_t{0});
    }

    void sessionsThatAreOverDoNotFillIt()
    {
        const auto owners = ownersOf({1, 2, 3});
        PacketOwners<Owner> index;
        for (std::uint64_t token = 10; token < 1000; ++token) {
            owners.at(1)->token = token;
            QCOMPARE(index.find(token, owners), owners.at(1).get());
            QVERIFY(index.size() <= 6);
        }
    }
};

QTEST_GUILESS_MAIN(PacketOwnersTest)
#include "packet_owners_test.moc"
