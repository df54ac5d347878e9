<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
<context>
    <name>QObject</name>
    <message>
        <source>%1 is sent by %2 and not known to this console; it is not shown</source>
        <translation>%2 发送的 %1 是本控制台不认识的报文，不予显示</translation>
    </message>
    <message>
        <source>%1 of %2 does not have the fields that this console knows (%3); compare the message sets</source>
        <translation>%2 的 %1 缺少本控制台所知的字段（%3）；请核对报文集</translation>
    </message>
    <message>
        <source>%1: no device has the message set siat-cockpit; name this console&apos;s with --device</source>
        <translation>%1：没有设备使用报文集 siat-cockpit；请用 --device 指定本控制台</translation>
    </message>
    <message>
        <source>%1: %2 devices have the message set siat-cockpit; name this console&apos;s with --device</source>
        <translation>%1：有 %2 台设备使用报文集 siat-cockpit；请用 --device 指定本控制台</translation>
    </message>
    <message>
        <source>%1 asks for TLS: give --certificate, --key and --authority</source>
        <translation>%1 要求 TLS：请给出 --certificate、--key 和 --authority</translation>
    </message>
    <message>
        <source>%1 of %2 is not shown: this console works with %3</source>
        <translation>不显示 %2 的 %1：本控制台使用 %3</translation>
    </message>
    <message>
        <source>%1 of %2 is not shown: it is no device of that kind</source>
        <translation>不显示 %2 的 %1：该设备并非此类设备</translation>
    </message>
</context>
<context>
    <name>console::AboutView</name>
    <message>
        <source>To the cockpit  F1</source>
        <translation>到驾驶舱  F1</translation>
    </message>
    <message>
        <source>Facts</source>
        <translation>事实</translation>
    </message>
    <message>
        <source>Licences of the parts</source>
        <translation>各组成部分的许可证</translation>
    </message>
    <message>
        <source>About</source>
        <translation>关于</translation>
    </message>
    <message>
        <source>About LiENa</source>
        <translation>关于 LiENa</translation>
    </message>
    <message>
        <source>It comes without any warranty. Where its words sound like those of a standard it follows the conventions of that standard and claims no more.</source>
        <translation>不提供任何担保。其用语若与某项标准相似，仅表示遵循该标准的惯例，别无其他主张。</translation>
    </message>
    <message>
        <source>Parts used, and their licences as named by Debian 12</source>
        <translation>所用组成部分及其许可证（按 Debian 12 的名称）</translation>
    </message>
    <message>
        <source>Leave About</source>
        <translation>离开“关于”</translation>
    </message>
</context>
<context>
    <name>console::AlarmBand</name>
    <message>
        <source>SELF-TEST, no alarm: red, flashing fast, five pulses</source>
        <translation>自检，并非报警：红色，快闪，五声脉冲</translation>
    </message>
    <message>
        <source>SELF-TEST, no alarm: red, flashing fast, ten pulses</source>
        <translation>自检，并非报警：红色，快闪，十声脉冲</translation>
    </message>
    <message>
        <source>SELF-TEST, no alarm: yellow, flashing slowly, three pulses</source>
        <translation>自检，并非报警：黄色，慢闪，三声脉冲</translation>
    </message>
    <message>
        <source>SELF-TEST, no alarm: cyan, steady, two pulses</source>
        <translation>自检，并非报警：青色，常亮，两声脉冲</translation>
    </message>
    <message>
        <source>Acknowledge</source>
        <translation>确认</translation>
    </message>
    <message>
        <source>Alarms</source>
        <translation>报警</translation>
    </message>
    <message>
        <source>Acknowledge the alarm shown</source>
        <translation>确认所显示的报警</translation>
    </message>
    <message>
        <source>Pause the alarm sound for a while, or end the pause</source>
        <translation>暂停报警声一段时间，或结束暂停</translation>
    </message>
    <message>
        <source>Acknowledge: %1</source>
        <translation>确认：%1</translation>
    </message>
    <message>
        <source>Acknowledge ended: %1</source>
        <translation>确认已结束的报警：%1</translation>
    </message>
    <message>
        <source>ENDED %1 · %2</source>
        <translation>已结束 %1 · %2</translation>
    </message>
    <message>
        <source>It has ended; acknowledge that you saw it.</source>
        <translation>报警已结束；请确认您已看到。</translation>
    </message>
    <message>
        <source>No alarms</source>
        <translation>无报警</translation>
    </message>
    <message>
        <source>Show again: %1</source>
        <translation>再次显示：%1</translation>
    </message>
    <message>
        <source>AUDIO PAUSED %1 s</source>
        <translation>报警声暂停 %1 s</translation>
    </message>
    <message>
        <source>Sound stays on %1 s</source>
        <translation>报警声持续 %1 s</translation>
    </message>
    <message>
        <source>Pause sound (F9)</source>
        <translation>暂停报警声 (F9)</translation>
    </message>
    <message>
        <source>+%1 more</source>
        <translation>另有 %1 项</translation>
    </message>
    <message>
        <source>Were all three colours seen, and all three sounds heard?</source>
        <translation>三种颜色是否都看到，三种声音是否都听到？</translation>
    </message>
    <message>
        <source>No alarms. The alarm self-test was not confirmed: have screen and sound looked at</source>
        <translation>无报警。报警自检未经证实：让人检查屏幕和声音</translation>
    </message>
    <message>
        <source>No alarms. The alarm self-test is to be done before arming</source>
        <translation>无报警。解锁前须做报警自检</translation>
    </message>
    <message>
        <source>Incident</source>
        <translation>标记事件</translation>
    </message>
    <message>
        <source>Mark this moment in both logs as an incident</source>
        <translation>在两份日志中将此刻标记为事件</translation>
    </message>
    <message>
        <source>Marks this moment in both logs, with permit, picture and force</source>
        <translation>在两份日志中标记此刻，并记下运动许可、图像和受力</translation>
    </message>
    <message>
        <source>Marked</source>
        <translation>已标记</translation>
    </message>
</context>
<context>
    <name>console::AlarmJournal</name>
    <message>
        <source>%1 cannot be made</source>
        <translation>无法创建 %1</translation>
    </message>
    <message>
        <source>%1 is in use by another console</source>
        <translation>%1 正被另一控制台使用</translation>
    </message>
    <message>
        <source>%1 may not be written</source>
        <translation>没有写入 %1 的权限</translation>
    </message>
    <message>
        <source>%1 cannot be opened: %2</source>
        <translation>无法打开 %1：%2</translation>
    </message>
    <message>
        <source>%1: a line does not follow from the one before it; the file was changed or damaged. </source>
        <translation>%1：有一行与前一行不衔接；文件被改动或已损坏。</translation>
    </message>
    <message>
        <source>%1: the last line is torn, as a loss of power leaves it; it was dropped. </source>
        <translation>%1：最后一行不完整（断电所致），已舍弃。</translation>
    </message>
    <message>
        <source>the disk of %1 is nearly full, %2 MB left</source>
        <translation>%1 所在磁盘将满，剩余 %2 MB</translation>
    </message>
    <message>
        <source>%1 entries were lost, the disk is too slow</source>
        <translation>丢失 %1 条记录，磁盘过慢</translation>
    </message>
    <message>
        <source>%1 is not kept: %2</source>
        <translation>%1 未保存：%2</translation>
    </message>
    <message>
        <source>%1 cannot be put aside: %2</source>
        <translation>无法将 %1 改存为旧文件：%2</translation>
    </message>
    <message>
        <source>%1 cannot be written: %2</source>
        <translation>无法写入 %1：%2</translation>
    </message>
    <message>
        <source>%1 cannot be put right: %2</source>
        <translation>无法修复 %1：%2</translation>
    </message>
</context>
<context>
    <name>console::AlarmList</name>
    <message>
        <source>ended: %1</source>
        <translation>结束：%1</translation>
    </message>
    <message>
        <source>raised: %1</source>
        <translation>发生：%1</translation>
    </message>
    <message>
        <source>acknowledged: %1</source>
        <translation>已确认：%1</translation>
    </message>
    <message>
        <source>acknowledged by %1: %2</source>
        <translation>已由 %1 确认：%2</translation>
    </message>
    <message>
        <source>audio paused</source>
        <translation>报警声已暂停</translation>
    </message>
    <message>
        <source>audio paused by %1</source>
        <translation>报警声已由 %1 暂停</translation>
    </message>
    <message>
        <source>audio pause ended</source>
        <translation>报警声暂停已结束</translation>
    </message>
</context>
<context>
    <name>console::AlarmRules</name>
    <message>
        <source>%1: its topology or message sets are others than ours</source>
        <translation>%1：其拓扑或报文集与本方不同</translation>
    </message>
    <message>
        <source>Give both sides the same files; do not arm.</source>
        <translation>让两端使用相同的文件；不要解锁。</translation>
    </message>
    <message>
        <source>%1: %2 overdue</source>
        <translation>%1：%2逾时未到</translation>
    </message>
    <message>
        <source>Look at that device; what is shown of it is old.</source>
        <translation>查看该设备；所显示的是其旧数据。</translation>
    </message>
    <message>
        <source>%1: clock uncertain, ages unknown</source>
        <translation>%1：时钟不确定，时龄未知</translation>
    </message>
    <message>
        <source>Wait; arming is refused until the clocks are compared.</source>
        <translation>等待时钟比对；完成前拒绝解锁。</translation>
    </message>
    <message>
        <source>%1: picture link lost, stand-by</source>
        <translation>%1：图像链路丢失，待机</translation>
    </message>
    <message>
        <source>%1: link lost, stand-by</source>
        <translation>%1：链路丢失，待机</translation>
    </message>
    <message>
        <source>Read the prompt, then re-open the channel.</source>
        <translation>阅读提示单，然后重新打开通道。</translation>
    </message>
    <message>
        <source>%1: picture link interrupted</source>
        <translation>%1：图像链路已中断</translation>
    </message>
    <message>
        <source>%1: link interrupted</source>
        <translation>%1：链路已中断</translation>
    </message>
    <message>
        <source>%1: picture link closed while armed</source>
        <translation>%1：图像链路在使能期间被关闭</translation>
    </message>
    <message>
        <source>%1: link closed while armed</source>
        <translation>%1：链路在使能期间被关闭</translation>
    </message>
    <message>
        <source>Ask the patient side why; open it again before you arm.</source>
        <translation>请询问患者侧原因；使能之前请重新打开它。</translation>
    </message>
    <message>
        <source>Let go of the dead-man; motion has ended and needs a new ARM.</source>
        <translation>松开握持开关；运动已结束，须重新解锁。</translation>
    </message>
    <message>
        <source>%1 times in a minute</source>
        <translation>一分钟内 %1 次</translation>
    </message>
    <message>
        <source>jitter above %1 ms</source>
        <translation>抖动超过 %1 ms</translation>
    </message>
    <message>
        <source>more than %1 % lost</source>
        <translation>丢失超过 %1 %</translation>
    </message>
    <message>
        <source>%1: link unsteady, %2</source>
        <translation>%1：链路不稳定，%2</translation>
    </message>
    <message>
        <source>Check the line before you arm.</source>
        <translation>解锁前检查线路。</translation>
    </message>
    <message>
        <source>%1: commands take %2 ms there and back</source>
        <translation>%1：指令往返耗时 %2 ms</translation>
    </message>
    <message>
        <source>Move slowly and wait for the picture, or stop; have the line looked at.</source>
        <translation>缓慢操作并等待图像跟上，或停止；让人检查线路。</translation>
    </message>
    <message>
        <source>Move slowly and wait for the picture.</source>
        <translation>缓慢操作并等待图像跟上。</translation>
    </message>
    <message>
        <source>Robot&apos;s hold NOT CONFIRMED</source>
        <translation>机器人保持未经证实</translation>
    </message>
    <message>
        <source>Ask the patient side now whether the robot stands still.</source>
        <translation>立即询问患者端机器人是否静止。</translation>
    </message>
    <message>
        <source>EMERGENCY STOP is in force</source>
        <translation>急停生效中</translation>
    </message>
    <message>
        <source>Settle why it was pressed before it is reset.</source>
        <translation>复位前查明按下急停的原因。</translation>
    </message>
    <message>
        <source>Picture %1</source>
        <translation>图像：%1</translation>
    </message>
    <message>
        <source>Have the line to the X-ray system looked at; mind fine wires.</source>
        <translation>让人检查到 X 射线系统的线路；留意细导丝。</translation>
    </message>
    <message>
        <source>Picture was older than %1 ms for a moment</source>
        <translation>图像曾短暂超过 %1 ms</translation>
    </message>
    <message>
        <source>Picture FROZEN, older than %1 ms</source>
        <translation>图像已冻结，时龄超过 %1 ms</translation>
    </message>
    <message>
        <source>Picture&apos;s age is unknown</source>
        <translation>图像时龄未知</translation>
    </message>
    <message>
        <source>Let go of the dead-man; motion is inhibited.</source>
        <translation>松开握持开关；运动已被禁止。</translation>
    </message>
    <message>
        <source>Guidewire force %1 N</source>
        <translation>导丝受力 %1 N</translation>
    </message>
    <message>
        <source>FORCE STOP: %1</source>
        <translation>力超限停止：%1</translation>
    </message>
    <message>
        <source>Do not push on; look at the picture and retract a little.</source>
        <translation>不要继续推送；查看图像并稍稍后撤。</translation>
    </message>
    <message>
        <source>Advance no further; look at the tip.</source>
        <translation>不要再推进；查看头端。</translation>
    </message>
    <message>
        <source>Robot: %1</source>
        <translation>机器人：%1</translation>
    </message>
    <message>
        <source>Robot: drives are not healthy</source>
        <translation>机器人：驱动器不正常</translation>
    </message>
    <message>
        <source>Do not arm; have the drives looked at.</source>
        <translation>不要解锁；让人检查驱动器。</translation>
    </message>
    <message>
        <source>Move the other way.</source>
        <translation>向反方向移动。</translation>
    </message>
    <message>
        <source>Hard limit reached</source>
        <translation>已到硬限位</translation>
    </message>
    <message>
        <source>Soft limit reached</source>
        <translation>已到软限位</translation>
    </message>
    <message>
        <source>Tracker: no valid tip position</source>
        <translation>跟踪器：无有效的头端位置</translation>
    </message>
    <message>
        <source>Go by the picture alone; what is shown of the tip is old.</source>
        <translation>只以图像为准；所显示的头端位置是旧数据。</translation>
    </message>
    <message>
        <source>Contrast EMPTY during an injection</source>
        <translation>注射期间造影剂耗尽</translation>
    </message>
    <message>
        <source>Have the patient side refill the injector and look for air.</source>
        <translation>让患者端重新装填注射器并检查有无空气。</translation>
    </message>
    <message>
        <source>Contrast %1 mL, below one injection</source>
        <translation>造影剂 %1 mL，不足一次注射</translation>
    </message>
    <message>
        <source>Have the patient side refill the injector.</source>
        <translation>让患者端重新装填注射器。</translation>
    </message>
    <message>
        <source>Air kerma has reached %1 Gy</source>
        <translation>空气比释动能已达 %1 Gy</translation>
    </message>
    <message>
        <source>Weigh the dose against what is still to do.</source>
        <translation>权衡剂量与尚需完成的操作。</translation>
    </message>
    <message>
        <source>Console paints %1 of %2 pictures a second</source>
        <translation>控制台每秒只显示 %2 幅图像中的 %1 幅</translation>
    </message>
    <message>
        <source>Close other programs on this computer; mind fast motion.</source>
        <translation>关闭本机其他程序；快速运动时要小心。</translation>
    </message>
    <message>
        <source>Recording: %1</source>
        <translation>记录：%1</translation>
    </message>
    <message>
        <source>Make room on the disk, or have the computer looked at.</source>
        <translation>腾出磁盘空间，或让人检查计算机。</translation>
    </message>
    <message>
        <source>No alarm sound: %1</source>
        <translation>无报警声：%1</translation>
    </message>
    <message>
        <source>Keep this band in view; connect a loudspeaker.</source>
        <translation>始终留意本报警栏；接上扬声器。</translation>
    </message>
    <message>
        <source>No alarm if this program hangs: %1</source>
        <translation>若本程序停止响应将不会报警：%1</translation>
    </message>
    <message>
        <source>Watch the liveness mark; start the console anew before the next procedure.</source>
        <translation>留意图像活动标记；下一台手术前重新启动控制台。</translation>
    </message>
    <message>
        <source>, </source>
        <translation>，</translation>
    </message>
    <message>
        <source>; </source>
        <translation>；</translation>
    </message>
    <message>
        <source>EMERGENCY STOP NOT HEARD by the robot</source>
        <translation>机器人未收到急停</translation>
    </message>
    <message>
        <source>Use the stop at the patient side now. This console goes on asking.</source>
        <translation>立即使用患者端的急停。本控制台将继续发送请求。</translation>
    </message>
    <message>
        <source>Fluoroscopy has reached %1 min</source>
        <translation>透视已达 %1 min</translation>
    </message>
    <message>
        <source>%1: one of two ways is lost, no UDP packets pass</source>
        <translation>%1：两条通路失去其一，UDP 数据包不通</translation>
    </message>
    <message>
        <source>The session goes on by TCP, where a lost segment delays commands; have the network looked at.</source>
        <translation>会话经 TCP 继续，丢失的分段会延迟指令；让人检查网络。</translation>
    </message>
    <message>
        <source>Roadmap removed: %1</source>
        <translation>路图已移除：%1</translation>
    </message>
    <message>
        <source>Go by the live picture; make a new roadmap with contrast.</source>
        <translation>以实时图像为准；注射造影剂后重新制作路图。</translation>
    </message>
    <message>
        <source>Robotic arm: fault</source>
        <translation>机械臂：故障</translation>
    </message>
    <message>
        <source>Robot: a drive is off</source>
        <translation>机器人：有驱动器未启用</translation>
    </message>
    <message>
        <source>Link between %1 and %2 lost, stand-by</source>
        <translation>%1 与 %2 之间的链路丢失，待机</translation>
    </message>
    <message>
        <source>Read the prompt, then have the channel re-opened at one of the two.</source>
        <translation>阅读提示单，然后让人在其中一台设备上重新打开通道。</translation>
    </message>
    <message>
        <source>Pictures are refused: %1</source>
        <translation>图像被拒绝：%1</translation>
    </message>
    <message>
        <source>Let go of the pedal; have the X-ray system and this console looked at.</source>
        <translation>松开踏板；让人检查 X 射线系统和本控制台。</translation>
    </message>
    <message>
        <source>No picture is shown</source>
        <translation>没有显示图像</translation>
    </message>
    <message>
        <source>Let go of the pedal and press it again; then have the X-ray system and the line to it looked at.</source>
        <translation>松开踏板并重新踩下；若仍无图像，让人检查 X 射线系统及其线路。</translation>
    </message>
    <message>
        <source>Picture slow, fewer than %1 a second</source>
        <translation>图像过慢，每秒少于 %1 幅</translation>
    </message>
    <message>
        <source>Move slowly; have the line to the X-ray system looked at.</source>
        <translation>缓慢操作；让人检查到 X 射线系统的线路。</translation>
    </message>
</context>
<context>
    <name>console::AlarmService</name>
    <message>
        <source>the operator</source>
        <translation>操作者</translation>
    </message>
    <message>
        <source>alarms are not kept, no folder was named</source>
        <translation>报警不会保存，未指定文件夹</translation>
    </message>
    <message>
        <source>alarm log: %1</source>
        <translation>报警日志：%1</translation>
    </message>
    <message>
        <source>console started. %1</source>
        <translation>控制台已启动。%1</translation>
    </message>
    <message>
        <source>alarm sound is there</source>
        <translation>报警声可用</translation>
    </message>
    <message>
        <source>its watchdog has no sound</source>
        <translation>其看门狗没有声音</translation>
    </message>
    <message>
        <source>the watchdog has sound</source>
        <translation>看门狗有声音</translation>
    </message>
    <message>
        <source>no watchdog was named</source>
        <translation>未指定看门狗</translation>
    </message>
    <message>
        <source>the watchdog watches</source>
        <translation>看门狗正在监视</translation>
    </message>
    <message>
        <source>alarm self-test confirmed by %1</source>
        <translation>报警自检已由 %1 证实</translation>
    </message>
    <message>
        <source>alarm self-test not confirmed, by %1</source>
        <translation>报警自检未经证实，由 %1 回答</translation>
    </message>
    <message>
        <source>AGE %1 ms</source>
        <translation>时龄 %1 ms</translation>
    </message>
    <message>
        <source>AGE unknown</source>
        <translation>时龄未知</translation>
    </message>
    <message>
        <source>force %1 N</source>
        <translation>受力 %1 N</translation>
    </message>
    <message>
        <source>force unknown</source>
        <translation>受力未知</translation>
    </message>
    <message>
        <source>picture %1</source>
        <translation>图像 %1</translation>
    </message>
    <message>
        <source>, </source>
        <translation>，</translation>
    </message>
    <message>
        <source>incident marked by %1: %2</source>
        <translation>%1 标记了事件：%2</translation>
    </message>
    <message>
        <source>audio not paused again: armed, and the sound is back for less than %1 s</source>
        <translation>未再次暂停报警声：已解锁，且声音恢复不足 %1 s</translation>
    </message>
    <message>
        <source>console closed by %1</source>
        <translation>控制台由 %1 关闭</translation>
    </message>
</context>
<context>
    <name>console::AxisPanel</name>
    <message>
        <source>still</source>
        <translation>静止</translation>
    </message>
    <message>
        <source>advance</source>
        <translation>推进</translation>
    </message>
    <message>
        <source>retract</source>
        <translation>后撤</translation>
    </message>
    <message>
        <source>clockwise</source>
        <translation>顺时针</translation>
    </message>
    <message>
        <source>anticlockwise</source>
        <translation>逆时针</translation>
    </message>
    <message>
        <source>%1, %2 %3, %4</source>
        <translation>%1，%2 %3，%4</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>mm/s</source>
        <translation>mm/s</translation>
    </message>
    <message>
        <source>HARD LIMIT</source>
        <translation>硬限位</translation>
    </message>
    <message>
        <source>SOFT LIMIT</source>
        <translation>软限位</translation>
    </message>
    <message>
        <source>gripper —</source>
        <translation>夹持器 —</translation>
    </message>
    <message>
        <source>gripper closed</source>
        <translation>夹持器已夹紧</translation>
    </message>
    <message>
        <source>gripper open</source>
        <translation>夹持器已松开</translation>
    </message>
    <message>
        <source>turned %1</source>
        <translation>转角 %1</translation>
    </message>
    <message>
        <source>°</source>
        <translation>°</translation>
    </message>
    <message>
        <source>Guidewire</source>
        <translation>导丝</translation>
    </message>
    <message>
        <source>°/s</source>
        <translation>°/s</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 到 %2</translation>
    </message>
    <message>
        <source>; soft limits %1, hard limits %2</source>
        <translation>；软限位 %1，硬限位 %2</translation>
    </message>
    <message>
        <source>limits not reported</source>
        <translation>限位未报告</translation>
    </message>
    <message>
        <source>; drives %1, %2</source>
        <translation>；驱动器 %1，%2</translation>
    </message>
    <message>
        <source>%1 · %2</source>
        <translation>%1 · %2</translation>
    </message>
    <message>
        <source>°C</source>
        <translation>°C</translation>
    </message>
    <message>
        <source>A</source>
        <translation>A</translation>
    </message>
</context>
<context>
    <name>console::BurstPlayer</name>
    <message>
        <source>this computer has no sound output</source>
        <translation>本机没有声音输出</translation>
    </message>
    <message>
        <source>%1 does not take 16 bit at 44.1 kHz</source>
        <translation>%1 不支持 16 位 44.1 kHz</translation>
    </message>
    <message>
        <source>the sound output cannot be opened</source>
        <translation>无法打开声音输出</translation>
    </message>
    <message>
        <source>the sound output does not take what is sent to it</source>
        <translation>声音输出不接收所发送的数据</translation>
    </message>
    <message>
        <source>the sound output has failed</source>
        <translation>声音输出已失效</translation>
    </message>
</context>
<context>
    <name>console::ChecklistPane</name>
    <message>
        <source>missing</source>
        <translation>未满足</translation>
    </message>
    <message>
        <source>met</source>
        <translation>已满足</translation>
    </message>
    <message>
        <source>not asked for while armed</source>
        <translation>已解锁时不要求</translation>
    </message>
    <message>
        <source>Conditions for motion</source>
        <translation>运动条件</translation>
    </message>
    <message>
        <source>All %1 conditions are met</source>
        <translation>%1 项条件全部满足</translation>
    </message>
    <message>
        <source>1 of %1 conditions is missing</source>
        <translation>%1 项条件中有 1 项未满足</translation>
    </message>
    <message>
        <source>%1 of %2 conditions are missing</source>
        <translation>%2 项条件中有 %1 项未满足</translation>
    </message>
</context>
<context>
    <name>console::ChecklistView</name>
    <message>
        <source>Conditions for motion</source>
        <translation>运动条件</translation>
    </message>
    <message>
        <source>To the cockpit  F1</source>
        <translation>到驾驶舱  F1</translation>
    </message>
    <message>
        <source>Leave the conditions</source>
        <translation>离开运动条件</translation>
    </message>
</context>
<context>
    <name>console::ChoiceRow</name>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
</context>
<context>
    <name>console::CineReview</name>
    <message>
        <source>older than the %1 frames that are kept</source>
        <translation>早于所保留的 %1 帧</translation>
    </message>
    <message>
        <source>%1 of %2, %3 s before the newest</source>
        <translation>第 %1 帧，共 %2 帧，比最新帧早 %3 s</translation>
    </message>
</context>
<context>
    <name>console::Closing</name>
    <message>
        <source>Let go of ARM.</source>
        <translation>请松开“解锁”。</translation>
    </message>
    <message>
        <source>Let go of the dead-man. Where the robot does not hold then, close its link.</source>
        <translation>请松开握持开关。若机器人此后仍未保持，请关闭其链路。</translation>
    </message>
    <message>
        <source>Press F12 to hold, and let go of the dead-man.</source>
        <translation>请按 F12 保持，并松开握持开关。</translation>
    </message>
    <message>
        <source>the permit is %1</source>
        <translation>许可为 %1</translation>
    </message>
    <message>
        <source>contrast is being injected</source>
        <translation>正在注射造影剂</translation>
    </message>
    <message>
        <source>Wait until it has ended.</source>
        <translation>请等待其结束。</translation>
    </message>
    <message>
        <source>the X-ray pedal is down</source>
        <translation>X 射线踏板被踩下</translation>
    </message>
    <message>
        <source>Let go of it.</source>
        <translation>请松开它。</translation>
    </message>
    <message>
        <source>X-ray is on</source>
        <translation>正在出束</translation>
    </message>
    <message>
        <source>Wait until it is off.</source>
        <translation>请等待出束结束。</translation>
    </message>
    <message>
        <source>an emergency stop is on its way to the robot</source>
        <translation>急停正在发往机器人</translation>
    </message>
    <message>
        <source>Wait for the robot&apos;s answer.</source>
        <translation>请等待机器人的应答。</translation>
    </message>
    <message>
        <source>a high alarm is not acknowledged</source>
        <translation>有高优先级报警待您确认</translation>
    </message>
    <message>
        <source>Look at it, and acknowledge it.</source>
        <translation>请查看并确认该报警。</translation>
    </message>
</context>
<context>
    <name>console::ClosingNote</name>
    <message>
        <source>The cockpit was not closed</source>
        <translation>驾驶舱未关闭</translation>
    </message>
    <message>
        <source>Not closed: %1.</source>
        <translation>未关闭：%1。</translation>
    </message>
    <message>
        <source>%1 Then close the cockpit.</source>
        <translation>%1然后再关闭驾驶舱。</translation>
    </message>
</context>
<context>
    <name>console::CockpitApplication</name>
    <message>
        <source>the recording that comes with LiENa is missing; name one with --recording</source>
        <translation>缺少 LiENa 自带的录制文件；请用 --recording 指定一个</translation>
    </message>
    <message>
        <source>log saved: %1</source>
        <translation>日志已保存：%1</translation>
    </message>
    <message>
        <source>the unattended run, no person</source>
        <translation>无人值守运行，并非由人</translation>
    </message>
    <message>
        <source>picture refused: %1</source>
        <translation>图像被拒绝：%1</translation>
    </message>
    <message>
        <source>picture %1: the line does not carry more</source>
        <translation>图像：%1；线路无法承载更多</translation>
    </message>
    <message>
        <source>picture as asked for again, in rate and encoding</source>
        <translation>图像的帧率和编码已恢复到所要求的水平</translation>
    </message>
    <message>
        <source>report saved: %1</source>
        <translation>报告已保存：%1</translation>
    </message>
    <message>
        <source>Report saved: %1</source>
        <translation>报告已保存：%1</translation>
    </message>
    <message>
        <source>how is not set up</source>
        <translation>呼叫方式未设置</translation>
    </message>
    <message>
        <source>call the patient side: %1</source>
        <translation>呼叫患者端：%1</translation>
    </message>
    <message>
        <source>not closed: %1. %2</source>
        <translation>未关闭：%1。%2</translation>
    </message>
    <message>
        <source>the hand has no keys: %1</source>
        <translation>主手操作键无效：%1</translation>
    </message>
    <message>
        <source>the screen is in sight again</source>
        <translation>屏幕重新可见</translation>
    </message>
    <message>
        <source>--rehearsal lets a recording stand for the live picture, and &quot;%1&quot; at %2 is not on this computer: it may be a real robot; name devices at a loopback address in the topology, or start without --rehearsal</source>
        <translation>--rehearsal 使录制图像代替实时图像，而“%1”（%2）不在本机上：它可能是真实的机器人；请在拓扑中使用本机回环地址上的设备，或不带 --rehearsal 启动</translation>
    </message>
</context>
<context>
    <name>console::CockpitControl</name>
    <message>
        <source>the audit file is not written: %1</source>
        <translation>审计文件未能写入：%1</translation>
    </message>
    <message>
        <source>%1 -&gt; %2</source>
        <translation>%1 -&gt; %2</translation>
    </message>
    <message>
        <source>: %1</source>
        <translation>：%1</translation>
    </message>
    <message>
        <source>force of %1 N accepted for the next arming by %2</source>
        <translation>%2 已接受 %1 N 的力，用于下一次解锁</translation>
    </message>
    <message>
        <source>the operator</source>
        <translation>操作者</translation>
    </message>
    <message>
        <source>force of %1 N not accepted: it is another by now</source>
        <translation>未接受 %1 N 的力：此时力已不同</translation>
    </message>
    <message>
        <source>injection %1: the robot has not answered; look at the contrast left</source>
        <translation>注射 %1：机器人未应答；请查看造影剂余量</translation>
    </message>
    <message>
        <source>injection %1: %2, %3 mL</source>
        <translation>注射 %1：%2，%3 mL</translation>
    </message>
    <message>
        <source>the X-ray pedal counts at the console itself only, and this is remote input (%1)</source>
        <translation>X 射线踏板仅在控制台本机有效，而此处为远程输入（%1）</translation>
    </message>
</context>
<context>
    <name>console::CockpitWindow</name>
    <message>
        <source>Live image</source>
        <translation>实时图像</translation>
    </message>
    <message>
        <source>No picture.</source>
        <translation>无图像。</translation>
    </message>
    <message>
        <source>Reference image</source>
        <translation>参考图像</translation>
    </message>
    <message>
        <source>3-D scene</source>
        <translation>三维场景</translation>
    </message>
    <message>
        <source>No scene.</source>
        <translation>无场景。</translation>
    </message>
    <message>
        <source>LiENa cockpit — research system, not a medical device</source>
        <translation>LiENa 驾驶舱 — 研究用系统，非医疗器械</translation>
    </message>
    <message>
        <source>Cockpit</source>
        <translation>驾驶舱</translation>
    </message>
    <message>
        <source>Esc emergency stop · F12 hold · F9 audio pause</source>
        <translation>Esc 急停 · F12 保持 · F9 暂停报警声</translation>
    </message>
    <message>
        <source>F1 cockpit · F2 topology · F3 plots · F4 log · F6 conditions · F7 screens · F8 alarm test · F10 F11 swap · Ctrl+, preferences</source>
        <translation>F1 驾驶舱 · F2 拓扑 · F3 曲线 · F4 日志 · F6 运动条件 · F7 屏幕 · F8 报警自检 · F10 F11 互换 · Ctrl+, 首选项</translation>
    </message>
</context>
<context>
    <name>console::ContrastBar</name>
    <message>
        <source>Injections left</source>
        <translation>剩余注射次数</translation>
    </message>
    <message>
        <source>About %1 injections of %2 mL</source>
        <translation>约 %1 次，每次 %2 mL</translation>
    </message>
    <message>
        <source>Contrast left is not known</source>
        <translation>造影剂余量未知</translation>
    </message>
</context>
<context>
    <name>console::DiagnosisSheet</name>
    <message>
        <source>Diagnosis of a lost link</source>
        <translation>丢失链路的诊断</translation>
    </message>
    <message>
        <source>Fold</source>
        <translation>收起</translation>
    </message>
    <message>
        <source>Fold this sheet to a chip in the alarm band</source>
        <translation>将此提示单收起为报警栏中的标签</translation>
    </message>
    <message>
        <source>Particulars</source>
        <translation>详情</translation>
    </message>
    <message>
        <source>Is the patient safe?</source>
        <translation>患者是否安全？</translation>
    </message>
    <message>
        <source>What you see</source>
        <translation>您所看到的</translation>
    </message>
    <message>
        <source>Likely cause, and what to try</source>
        <translation>可能原因及处置</translation>
    </message>
    <message>
        <source>Evidence</source>
        <translation>依据</translation>
    </message>
    <message>
        <source>Re-open channel</source>
        <translation>重新打开通道</translation>
    </message>
    <message>
        <source>Re-open all lost</source>
        <translation>重新打开全部丢失的链路</translation>
    </message>
    <message>
        <source>Run checks</source>
        <translation>运行检查</translation>
    </message>
    <message>
        <source>Give up link…</source>
        <translation>放弃链路…</translation>
    </message>
    <message>
        <source>Give up this link, because the device will not return</source>
        <translation>放弃此链路，因为该设备不会恢复</translation>
    </message>
    <message>
        <source>The incident ends and the link stays closed. Give it up?</source>
        <translation>事件将结束，链路保持关闭。是否放弃？</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>保留</translation>
    </message>
    <message>
        <source>Give up link</source>
        <translation>放弃链路</translation>
    </message>
    <message>
        <source>Re-open all lost (%1)</source>
        <translation>重新打开全部丢失的链路 (%1)</translation>
    </message>
    <message>
        <source>Checking…</source>
        <translation>正在检查…</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Close this sheet</source>
        <translation>关闭此提示单</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>保存报告</translation>
    </message>
    <message>
        <source>Save what this sheet says as a file</source>
        <translation>把此提示单的内容保存为文件</translation>
    </message>
    <message>
        <source>Pause the alarm sound: F9</source>
        <translation>暂停报警声：F9</translation>
    </message>
    <message>
        <source>Re-opening…</source>
        <translation>正在重新打开…</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>细节</translation>
    </message>
    <message>
        <source>Show the details, for whoever has to find the cause</source>
        <translation>显示细节，供查找原因的人员使用</translation>
    </message>
    <message>
        <source>Call patient side</source>
        <translation>呼叫患者端</translation>
    </message>
    <message>
        <source>Show large how to call the patient side</source>
        <translation>放大显示患者端的呼叫方式</translation>
    </message>
</context>
<context>
    <name>console::DisplayChain</name>
    <message>
        <source>there is no memory for it</source>
        <translation>内存不足</translation>
    </message>
</context>
<context>
    <name>console::DisplayMeasurement</name>
    <message>
        <source>two words are expected: a level and its light in cd/m², or ambient and its light</source>
        <translation>应有两项：灰阶及其亮度 (cd/m²)，或 ambient 及其亮度</translation>
    </message>
    <message>
        <source>the light is not a number from 0 to 100000 cd/m²</source>
        <translation>亮度不是 0 到 100000 cd/m² 的数</translation>
    </message>
    <message>
        <source>the levels 0 and 255 must be among those measured</source>
        <translation>所测灰阶中必须包含 0 和 255</translation>
    </message>
    <message>
        <source>the level is not a whole number from 0 to 255</source>
        <translation>灰阶不是 0 到 255 的整数</translation>
    </message>
    <message>
        <source>level and light must both be greater than on the line before; measure again</source>
        <translation>灰阶与亮度都必须大于前一行；请重新测量</translation>
    </message>
    <message>
        <source>%1 cannot be read: %2. Name a display&apos;s measurement.</source>
        <translation>无法读取 %1：%2。请指定显示器的测量文件。</translation>
    </message>
    <message>
        <source>%1 is larger than 64 KiB and is no display&apos;s measurement.</source>
        <translation>%1 大于 64 KiB，不是显示器的测量文件。</translation>
    </message>
    <message>
        <source>%1:%2: %3.</source>
        <translation>%1:%2：%3。</translation>
    </message>
</context>
<context>
    <name>console::DisplaySettings</name>
    <message>
        <source>as sent</source>
        <translation>原始窗</translation>
    </message>
    <message>
        <source>AUTO</source>
        <translation>自动</translation>
    </message>
    <message>
        <source>full range</source>
        <translation>全范围</translation>
    </message>
    <message>
        <source>half width</source>
        <translation>窗宽减半</translation>
    </message>
    <message>
        <source>twice the width</source>
        <translation>窗宽加倍</translation>
    </message>
    <message>
        <source>by hand</source>
        <translation>手动</translation>
    </message>
    <message>
        <source>no shutter</source>
        <translation>无电子遮光</translation>
    </message>
    <message>
        <source>round shutter</source>
        <translation>圆形电子遮光</translation>
    </message>
    <message>
        <source>square shutter</source>
        <translation>方形电子遮光</translation>
    </message>
    <message>
        <source>unsharp mask</source>
        <translation>反锐化掩模</translation>
    </message>
    <message>
        <source>multi-scale</source>
        <translation>多尺度</translation>
    </message>
</context>
<context>
    <name>console::DisplayState</name>
    <message>
        <source>off</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>distance</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>angle</source>
        <translation>角度</translation>
    </message>
</context>
<context>
    <name>console::DosePanel</name>
    <message>
        <source>Contrast and dose</source>
        <translation>造影剂与剂量</translation>
    </message>
    <message>
        <source>Contrast left</source>
        <translation>剩余造影剂</translation>
    </message>
    <message>
        <source>Last injection</source>
        <translation>上次注射</translation>
    </message>
    <message>
        <source>Fluoroscopy time</source>
        <translation>透视时间</translation>
    </message>
    <message>
        <source>Air kerma</source>
        <translation>空气比释动能</translation>
    </message>
    <message>
        <source>Kerma rate</source>
        <translation>比释动能率</translation>
    </message>
    <message>
        <source>Dose-area product</source>
        <translation>剂量面积乘积</translation>
    </message>
    <message>
        <source>Contrast from the robot, never received</source>
        <translation>机器人的造影剂数据，从未收到</translation>
    </message>
    <message>
        <source>mL</source>
        <translation>mL</translation>
    </message>
    <message>
        <source>Contrast from the robot, %1</source>
        <translation>机器人的造影剂数据，%1</translation>
    </message>
    <message>
        <source>mGy</source>
        <translation>mGy</translation>
    </message>
    <message>
        <source>mGy/min</source>
        <translation>mGy/min</translation>
    </message>
    <message>
        <source>Gy·cm²</source>
        <translation>Gy·cm²</translation>
    </message>
    <message>
        <source>Repeated from the X-ray system, %1</source>
        <translation>X 射线系统数据转发，%1</translation>
    </message>
    <message>
        <source>≈ %1 injections · %2 mL/s</source>
        <translation>≈ %1 次注射 · %2 mL/s</translation>
    </message>
    <message>
        <source>%1, %2 ago</source>
        <translation>%1，%2 前</translation>
    </message>
</context>
<context>
    <name>console::EglContext</name>
    <message>
        <source>EGL offers no OpenGL 3.2 here (EGL error 0x%1). Install a graphics driver; Mesa&apos;s software driver is enough.</source>
        <translation>此处 EGL 不提供 OpenGL 3.2（EGL 错误 0x%1）。请安装显卡驱动；Mesa 的软件驱动即可。</translation>
    </message>
</context>
<context>
    <name>console::ForceGauge</name>
    <message>
        <source>Force on the guidewire</source>
        <translation>导丝受力</translation>
    </message>
    <message>
        <source>%1, peak %2, %3</source>
        <translation>%1，峰值 %2，%3</translation>
    </message>
    <message>
        <source>N</source>
        <translation>N</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>受力</translation>
    </message>
    <message>
        <source>stop 2 N</source>
        <translation>停止 2 N</translation>
    </message>
    <message>
        <source>warn %1</source>
        <translation>警告 %1</translation>
    </message>
    <message>
        <source>stop %1</source>
        <translation>停止 %1</translation>
    </message>
    <message>
        <source>no force</source>
        <translation>无受力</translation>
    </message>
    <message>
        <source>resistance</source>
        <translation>阻力</translation>
    </message>
    <message>
        <source>pull</source>
        <translation>拉力</translation>
    </message>
    <message>
        <source>peak %1</source>
        <translation>峰值 %1</translation>
    </message>
    <message>
        <source>10 s</source>
        <translation>10 s</translation>
    </message>
</context>
<context>
    <name>console::FrameDecoder</name>
    <message>
        <source>its size %1 x %2 is not within 1 to 4096</source>
        <translation>其尺寸 %1 x %2 不在 1 到 4096 之间</translation>
    </message>
    <message>
        <source>%1 bits stored are not within 1 to 16</source>
        <translation>存储位数 %1 不在 1 到 16 之间</translation>
    </message>
    <message>
        <source>it holds no pixels</source>
        <translation>其中没有像素</translation>
    </message>
    <message>
        <source>its %1 encoded bytes are more than 16 MiB</source>
        <translation>其编码后的 %1 字节超过 16 MiB</translation>
    </message>
    <message>
        <source>%1 x %2 pixels take %3 bytes, and it has %4</source>
        <translation>%1 x %2 像素需要 %3 字节，而实际为 %4</translation>
    </message>
    <message>
        <source>the JPEG-LS picture is %1 x %2, the message says %3 x %4</source>
        <translation>JPEG-LS 图像为 %1 x %2，而报文称 %3 x %4</translation>
    </message>
    <message>
        <source>the JPEG-LS picture has %1 bits, the message says %2</source>
        <translation>JPEG-LS 图像为 %1 位，而报文称 %2 位</translation>
    </message>
    <message>
        <source>its pixels may be off by %1, the message says by at most %2</source>
        <translation>其像素误差可达 %1，而报文称至多 %2</translation>
    </message>
    <message>
        <source>the JPEG-LS data are damaged</source>
        <translation>JPEG-LS 数据已损坏</translation>
    </message>
    <message>
        <source>a JPEG picture has 8 bits, the message says %1</source>
        <translation>JPEG 图像为 8 位，而报文称 %1 位</translation>
    </message>
    <message>
        <source>the JPEG decoder could not start</source>
        <translation>JPEG 解码器无法启动</translation>
    </message>
    <message>
        <source>the JPEG header cannot be read: %1</source>
        <translation>无法读取 JPEG 文件头：%1</translation>
    </message>
    <message>
        <source>the JPEG picture is not grey</source>
        <translation>JPEG 图像不是灰度图</translation>
    </message>
    <message>
        <source>the JPEG picture is %1 x %2, the message says %3 x %4</source>
        <translation>JPEG 图像为 %1 x %2，而报文称 %3 x %4</translation>
    </message>
    <message>
        <source>the JPEG picture cannot be decoded: %1</source>
        <translation>无法解码 JPEG 图像：%1</translation>
    </message>
    <message>
        <source>its encoding %1 is unknown</source>
        <translation>其编码 %1 未知</translation>
    </message>
    <message>
        <source>it cannot be decoded: %1</source>
        <translation>无法解码：%1</translation>
    </message>
</context>
<context>
    <name>console::FramePipeline</name>
    <message>
        <source>it is the same as the one before it, though it says that it is new</source>
        <translation>它与前一幅完全相同，却自称是新的</translation>
    </message>
</context>
<context>
    <name>console::GamePadMaster</name>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>%1 (+%2)</source>
        <translation>%1 (+%2)</translation>
    </message>
    <message>
        <source>left trigger dead-man · sticks guidewire, catheter · right shoulder clutch · Start arm · cross scale · B hold · F X-ray</source>
        <translation>左扳机 握持开关 · 摇杆 导丝、导管 · 右肩键 离合 · Start 解锁 · 十字键 运动比例 · B 保持 · F X 射线</translation>
    </message>
    <message>
        <source>there, and not used: %1</source>
        <translation>已接入而未使用：%1</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
</context>
<context>
    <name>console::GuardList</name>
    <message>
        <source>Conditions for motion; F6 shows all of them</source>
        <translation>运动条件；F6 显示全部</translation>
    </message>
    <message>
        <source>All conditions are met</source>
        <translation>条件全部满足</translation>
    </message>
    <message>
        <source>Missing: %1</source>
        <translation>未满足：%1</translation>
    </message>
    <message>
        <source>and %1 more met</source>
        <translation>另有 %1 项已满足</translation>
    </message>
    <message>
        <source>and %1 more missing</source>
        <translation>另有 %1 项未满足</translation>
    </message>
    <message>
        <source>and %1 more missing, %2 met</source>
        <translation>另有 %1 项未满足，%2 项已满足</translation>
    </message>
    <message>
        <source>; </source>
        <translation>；</translation>
    </message>
</context>
<context>
    <name>console::Guards</name>
    <message>
        <source>Robot link is open</source>
        <translation>机器人链路已打开</translation>
    </message>
    <message>
        <source>Robot link is %1</source>
        <translation>机器人链路：%1</translation>
    </message>
    <message>
        <source>Heartbeats on time</source>
        <translation>心跳准时</translation>
    </message>
    <message>
        <source>%1 of %2 heartbeats on time</source>
        <translation>准时心跳 %1/%2 次</translation>
    </message>
    <message>
        <source>Clock uncertain by ±%1 ms</source>
        <translation>时钟不确定度 ±%1 ms</translation>
    </message>
    <message>
        <source>Clocks not yet compared</source>
        <translation>时钟尚未比对</translation>
    </message>
    <message>
        <source>Clocks compared</source>
        <translation>时钟已比对</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>图像：%1</translation>
    </message>
    <message>
        <source>Picture is a recording</source>
        <translation>图像是录制的</translation>
    </message>
    <message>
        <source>Another console has the robot: %1</source>
        <translation>机器人由另一控制台占用：%1</translation>
    </message>
    <message>
        <source>Picture&apos;s age is unknown</source>
        <translation>图像时龄未知</translation>
    </message>
    <message>
        <source>Picture may be %1 ms old, at most %2 ms</source>
        <translation>图像时龄可能达 %1 ms，上限 %2 ms</translation>
    </message>
    <message>
        <source>Picture slow: %1 of %2 a second</source>
        <translation>图像过慢：每秒 %1/%2 幅</translation>
    </message>
    <message>
        <source>Picture live for %1 of %2 s</source>
        <translation>图像实时已 %1/%2 s</translation>
    </message>
    <message>
        <source>Picture is live</source>
        <translation>图像是实时的</translation>
    </message>
    <message>
        <source>Robot reports %1</source>
        <translation>机器人报告：%1</translation>
    </message>
    <message>
        <source>Robot&apos;s hold is not known</source>
        <translation>机器人是否保持未知</translation>
    </message>
    <message>
        <source>Robot has not confirmed its hold</source>
        <translation>机器人尚未证实保持</translation>
    </message>
    <message>
        <source>Robot has not issued a new permit</source>
        <translation>机器人尚未签发新许可</translation>
    </message>
    <message>
        <source>Robot holds and is ready</source>
        <translation>机器人保持且就绪</translation>
    </message>
    <message>
        <source>Tip is tracked</source>
        <translation>头端正在跟踪</translation>
    </message>
    <message>
        <source>Tip not tracked, not shown</source>
        <translation>头端未跟踪，不予显示</translation>
    </message>
    <message>
        <source>Tip is shown where it was last</source>
        <translation>显示的是头端最后已知位置</translation>
    </message>
    <message>
        <source>Force near zero</source>
        <translation>受力接近零</translation>
    </message>
    <message>
        <source>Force %1 N</source>
        <translation>受力 %1 N</translation>
    </message>
    <message>
        <source>Force is not known</source>
        <translation>受力未知</translation>
    </message>
    <message>
        <source>Same system on both sides</source>
        <translation>两端系统一致</translation>
    </message>
    <message>
        <source>Robot&apos;s commands differ (F4)</source>
        <translation>机器人的指令不同 (F4)</translation>
    </message>
    <message>
        <source>System not confirmed</source>
        <translation>系统一致性未经证实</translation>
    </message>
    <message>
        <source>Robot reports</source>
        <translation>机器人有报告</translation>
    </message>
    <message>
        <source>No recent robot report</source>
        <translation>近期没有机器人报告</translation>
    </message>
    <message>
        <source>Drives are healthy</source>
        <translation>驱动器正常</translation>
    </message>
    <message>
        <source>Robotic arm: fault</source>
        <translation>机械臂：故障</translation>
    </message>
    <message>
        <source>Drives faulty or unknown</source>
        <translation>驱动器不正常或未知</translation>
    </message>
    <message>
        <source>Nothing waits to be sent</source>
        <translation>无报文待发送</translation>
    </message>
    <message>
        <source>%1 messages wait to be sent</source>
        <translation>%1 条报文待发送</translation>
    </message>
    <message>
        <source>No incident</source>
        <translation>无事件</translation>
    </message>
    <message>
        <source>An incident is not resolved</source>
        <translation>有事件未解决</translation>
    </message>
    <message>
        <source>No high alarm</source>
        <translation>无高优先级报警</translation>
    </message>
    <message>
        <source>A high alarm is not acknowledged</source>
        <translation>有高优先级报警待您确认</translation>
    </message>
    <message>
        <source>Hand control is there</source>
        <translation>主手可用</translation>
    </message>
    <message>
        <source>No hand control answers</source>
        <translation>主手无应答</translation>
    </message>
    <message>
        <source>Window has the keyboard</source>
        <translation>窗口有键盘焦点</translation>
    </message>
    <message>
        <source>The keyboard is elsewhere</source>
        <translation>键盘焦点在别处</translation>
    </message>
    <message>
        <source>A screen is gone: click into the cockpit</source>
        <translation>屏幕已移除：请点击驾驶舱</translation>
    </message>
    <message>
        <source>Dead-man released</source>
        <translation>握持开关已松开</translation>
    </message>
    <message>
        <source>Let go of the dead-man</source>
        <translation>请松开握持开关</translation>
    </message>
    <message>
        <source>Alarms were tested</source>
        <translation>报警自检已完成</translation>
    </message>
    <message>
        <source>Alarm self-test is due (F8)</source>
        <translation>须做报警自检 (F8)</translation>
    </message>
    <message>
        <source>No interruption is unread</source>
        <translation>没有未读的中断说明</translation>
    </message>
    <message>
        <source>The interruption is not over</source>
        <translation>中断尚未结束</translation>
    </message>
    <message>
        <source>Read &quot;While you were away&quot;</source>
        <translation>请阅读“中断期间”</translation>
    </message>
    <message>
        <source>Force %1 N, accepted</source>
        <translation>受力 %1 N，已接受</translation>
    </message>
    <message>
        <source>Commands are quick</source>
        <translation>指令往返及时</translation>
    </message>
    <message>
        <source>Round trip not yet measured</source>
        <translation>往返时间尚未测得</translation>
    </message>
    <message>
        <source>Patient side: clear to arm</source>
        <translation>患者端：允许解锁</translation>
    </message>
    <message>
        <source>One person may arm</source>
        <translation>可由一人解锁</translation>
    </message>
    <message>
        <source>Patient side has not said &quot;clear&quot;</source>
        <translation>患者端尚未允许解锁</translation>
    </message>
    <message>
        <source>Patient side not heard</source>
        <translation>未收到患者端消息</translation>
    </message>
    <message>
        <source>Alarm log is not kept</source>
        <translation>报警日志未保存</translation>
    </message>
    <message>
        <source>It is not known how late the robot takes commands</source>
        <translation>机器人可接受的指令延迟未知</translation>
    </message>
    <message>
        <source>Commands take %1 ms there and back, the robot takes them up to %2 ms</source>
        <translation>指令往返需 %1 ms，机器人最多接受 %2 ms</translation>
    </message>
    <message>
        <source>Logs are kept</source>
        <translation>日志正在保存</translation>
    </message>
    <message>
        <source>Audit file is not kept</source>
        <translation>审计文件未保存</translation>
    </message>
    <message>
        <source>Commands take %1 ms there and back, %2</source>
        <translation>指令往返需 %1 ms，%2</translation>
    </message>
    <message>
        <source>at most %1 ms to arm</source>
        <translation>解锁时最多 %1 ms</translation>
    </message>
    <message>
        <source>at most %1 ms while armed</source>
        <translation>已解锁后最多 %1 ms</translation>
    </message>
    <message>
        <source>This console only observes</source>
        <translation>本控制台仅供观察</translation>
    </message>
    <message>
        <source>Remote input: %1</source>
        <translation>远程输入：%1</translation>
    </message>
</context>
<context>
    <name>console::HandBlock</name>
    <message>
        <source>Hand</source>
        <translation>主手</translation>
    </message>
    <message>
        <source>Dead-man</source>
        <translation>握持开关</translation>
    </message>
    <message>
        <source>released</source>
        <translation>已松开</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>Guidewire</source>
        <translation>导丝</translation>
    </message>
    <message>
        <source>advance +00.0 mm/s</source>
        <translation>推进 +00.0 mm/s</translation>
    </message>
    <message>
        <source>FORCE TO HAND</source>
        <translation>主手力反馈</translation>
    </message>
    <message>
        <source>resistance 0.00 N</source>
        <translation>阻力 0.00 N</translation>
    </message>
    <message>
        <source>%1 has armed the robot: the dead-man at the robot is not yours</source>
        <translation>%1 已解锁机器人：机器人端的握持开关不是您的</translation>
    </message>
    <message>
        <source>%1 (that of %2)</source>
        <translation>%1（%2 的握持开关）</translation>
    </message>
    <message>
        <source>Of %1</source>
        <translation>属于 %1</translation>
    </message>
    <message>
        <source>Dead-man sent %1, at the robot %2, clutch %3</source>
        <translation>握持开关：已发送 %1，机器人端 %2，离合 %3</translation>
    </message>
    <message>
        <source>pressed</source>
        <translation>已按下</translation>
    </message>
    <message>
        <source>, force to hand %1</source>
        <translation>，主手力反馈 %1</translation>
    </message>
    <message>
        <source>, scale %1</source>
        <translation>，运动比例 %1</translation>
    </message>
    <message>
        <source>Sent</source>
        <translation>已发送</translation>
    </message>
    <message>
        <source>At the robot</source>
        <translation>机器人端</translation>
    </message>
    <message>
        <source>Clutch</source>
        <translation>离合</translation>
    </message>
    <message>
        <source>console only</source>
        <translation>仅在控制台</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>resistance</source>
        <translation>阻力</translation>
    </message>
    <message>
        <source>pull</source>
        <translation>拉力</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>N</source>
        <translation>N</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>运动比例</translation>
    </message>
    <message>
        <source>%1 : 1</source>
        <translation>%1 : 1</translation>
    </message>
    <message>
        <source>%1 : 1, was %2</source>
        <translation>%1 : 1，原为 %2</translation>
    </message>
    <message>
        <source>mm/s</source>
        <translation>mm/s</translation>
    </message>
    <message>
        <source>Catheter</source>
        <translation>导管</translation>
    </message>
    <message>
        <source>Asked by the hand</source>
        <translation>主手要求</translation>
    </message>
</context>
<context>
    <name>console::HandDesk</name>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>hand: %1, %2</source>
        <translation>主手：%1，%2</translation>
    </message>
    <message>
        <source>scale %1 : 1, before %2 : 1</source>
        <translation>运动比例 %1 : 1，此前 %2 : 1</translation>
    </message>
</context>
<context>
    <name>console::InstrumentState</name>
    <message>
        <source>the robot was not heard any more; look at the contrast left</source>
        <translation>已收不到机器人的报告；请查看造影剂余量</translation>
    </message>
</context>
<context>
    <name>console::Interruption</name>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 min %2 s</source>
        <translation>%1 min %2 s</translation>
    </message>
    <message>
        <source>unknown: %1 neither before the loss nor now</source>
        <translation>未知：丢失前与现在均%1</translation>
    </message>
    <message>
        <source>unknown: %1 now</source>
        <translation>未知：现在%1</translation>
    </message>
    <message>
        <source>unknown: %1 before the loss</source>
        <translation>未知：丢失前%1</translation>
    </message>
    <message>
        <source>Lost</source>
        <translation>丢失</translation>
    </message>
    <message>
        <source>unknown which link</source>
        <translation>不知是哪条链路</translation>
    </message>
    <message>
        <source>Tip</source>
        <translation>头端</translation>
    </message>
    <message>
        <source>no valid tracker position</source>
        <translation>无有效的跟踪器位置</translation>
    </message>
    <message>
        <source>moved %1&#xa0;mm (tracker ±%2&#xa0;mm)</source>
        <translation>移动 %1&#xa0;mm（跟踪器 ±%2&#xa0;mm）</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>受力</translation>
    </message>
    <message>
        <source>%1&#xa0;N, as before</source>
        <translation>%1&#xa0;N，与之前相同</translation>
    </message>
    <message>
        <source>%1&#xa0;N before, %2&#xa0;N now (%3%4&#xa0;N)</source>
        <translation>之前 %1&#xa0;N，现在 %2&#xa0;N（%3%4&#xa0;N）</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>造影剂</translation>
    </message>
    <message>
        <source>unknown: %1&#xa0;mL before, %2&#xa0;mL now; filled up or started anew</source>
        <translation>未知：之前 %1&#xa0;mL，现在 %2&#xa0;mL；已重新装填或重新启动</translation>
    </message>
    <message>
        <source>%1&#xa0;mL used, %2&#xa0;mL left</source>
        <translation>已用 %1&#xa0;mL，剩余 %2&#xa0;mL</translation>
    </message>
    <message>
        <source>X-ray time</source>
        <translation>X 射线时间</translation>
    </message>
    <message>
        <source>%1 s of beam</source>
        <translation>出束 %1 s</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>none was taken meanwhile</source>
        <translation>期间未拍摄</translation>
    </message>
    <message>
        <source>%1 taken, %2 of them did not come here</source>
        <translation>拍摄 %1 幅，其中 %2 幅未到达本端</translation>
    </message>
    <message>
        <source>C-arm and table</source>
        <translation>C 臂与床</translation>
    </message>
    <message>
        <source>LAO/RAO</source>
        <translation>LAO/RAO</translation>
    </message>
    <message>
        <source>CRA/CAU</source>
        <translation>CRA/CAU</translation>
    </message>
    <message>
        <source>detector</source>
        <translation>探测器</translation>
    </message>
    <message>
        <source>isocentre</source>
        <translation>等中心</translation>
    </message>
    <message>
        <source>table moved %1&#xa0;mm</source>
        <translation>床移动了 %1&#xa0;mm</translation>
    </message>
    <message>
        <source>where they were</source>
        <translation>位置未变</translation>
    </message>
    <message>
        <source>%1: distance unknown before</source>
        <translation>%1：此前距离未知</translation>
    </message>
    <message>
        <source>%1: distance unknown now</source>
        <translation>%1：现在距离未知</translation>
    </message>
    <message>
        <source>%1 at %2° before, %3° now</source>
        <translation>%1 此前为 %2°，现在为 %3°</translation>
    </message>
    <message>
        <source>Patient side</source>
        <translation>患者端</translation>
    </message>
    <message>
        <source>nothing that the robot&apos;s reports tell of</source>
        <translation>机器人的报告中没有任何变化</translation>
    </message>
    <message>
        <source>no report of the robot</source>
        <translation>没有机器人的报告</translation>
    </message>
    <message>
        <source>no report of the X-ray system</source>
        <translation>没有 X 射线系统的报告</translation>
    </message>
    <message>
        <source>unknown: the X-ray system counts anew</source>
        <translation>未知：X 射线系统已重新计数</translation>
    </message>
    <message>
        <source>robot: %1 before, %2 now</source>
        <translation>机器人：之前 %1，现在 %2</translation>
    </message>
    <message>
        <source>emergency stop pressed, in force</source>
        <translation>急停已按下，生效中</translation>
    </message>
    <message>
        <source>emergency stop ended</source>
        <translation>急停已解除</translation>
    </message>
    <message>
        <source>fault: %1</source>
        <translation>故障：%1</translation>
    </message>
    <message>
        <source>guidewire</source>
        <translation>导丝</translation>
    </message>
    <message>
        <source>catheter</source>
        <translation>导管</translation>
    </message>
    <message>
        <source>guidewire gripper</source>
        <translation>导丝夹持器</translation>
    </message>
    <message>
        <source>catheter gripper</source>
        <translation>导管夹持器</translation>
    </message>
    <message>
        <source>%1 at %2&#xa0;mm before, %3&#xa0;mm now</source>
        <translation>%1：之前 %2&#xa0;mm，现在 %3&#xa0;mm</translation>
    </message>
    <message>
        <source>%1 closed</source>
        <translation>%1已夹紧</translation>
    </message>
    <message>
        <source>%1 opened</source>
        <translation>%1已松开</translation>
    </message>
    <message>
        <source>drives: unknown</source>
        <translation>驱动器：未知</translation>
    </message>
    <message>
        <source>drives enabled: %1 of %3 before, %2 now</source>
        <translation>已启用的驱动器（共 %3）：之前 %1，现在 %2</translation>
    </message>
    <message>
        <source>Interrupted for %1, since %2</source>
        <translation>中断 %1，自 %2 起</translation>
    </message>
    <message>
        <source>%1 losses, interrupted for %2 in all, first at %3</source>
        <translation>丢失 %1 次，共中断 %2，首次于 %3</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
    <message>
        <source>; </source>
        <translation>；</translation>
    </message>
    <message>
        <source>%1 taken, all came</source>
        <translation>拍摄 %1 幅，全部到达</translation>
    </message>
</context>
<context>
    <name>console::InterruptionCard</name>
    <message>
        <source>Two reports are compared: the last before the loss, and the newest now. What was done and undone between them is not known here: ask the patient side.</source>
        <translation>此处比较两份报告：丢失前最后一份与现在最新一份。其间做过又撤销的操作在此无从得知：请询问患者端。</translation>
    </message>
    <message>
        <source>I have read this</source>
        <translation>我已阅读</translation>
    </message>
    <message>
        <source>While you were away</source>
        <translation>中断期间</translation>
    </message>
    <message>
        <source>I have read what happened while I was away</source>
        <translation>我已阅读中断期间发生的情况</translation>
    </message>
    <message>
        <source>What changed</source>
        <translation>有何变化</translation>
    </message>
</context>
<context>
    <name>console::InterruptionWatch</name>
    <message>
        <source>%1 link</source>
        <translation>%1 链路</translation>
    </message>
    <message>
        <source>link %1 – %2</source>
        <translation>链路 %1 – %2</translation>
    </message>
    <message>
        <source>account of the interruption read by %1: %2</source>
        <translation>中断说明已由 %1 阅读：%2</translation>
    </message>
    <message>
        <source>the operator</source>
        <translation>操作者</translation>
    </message>
</context>
<context>
    <name>console::JpegLsHeader</name>
    <message>
        <source>the bytes are no JPEG-LS picture</source>
        <translation>这些字节不是 JPEG-LS 图像</translation>
    </message>
    <message>
        <source>the JPEG-LS header is cut off</source>
        <translation>JPEG-LS 文件头不完整</translation>
    </message>
    <message>
        <source>the JPEG-LS picture has restart intervals, which are not supported</source>
        <translation>JPEG-LS 图像含重启间隔，不受支持</translation>
    </message>
    <message>
        <source>the JPEG-LS header has an unknown marker 0x%1</source>
        <translation>JPEG-LS 文件头含未知标记 0x%1</translation>
    </message>
    <message>
        <source>the JPEG-LS frame header is damaged</source>
        <translation>JPEG-LS 帧头已损坏</translation>
    </message>
    <message>
        <source>the JPEG-LS picture has %1 components instead of one</source>
        <translation>JPEG-LS 图像有 %1 个分量，应为一个</translation>
    </message>
    <message>
        <source>the JPEG-LS picture uses an extension that is not supported</source>
        <translation>JPEG-LS 图像使用了不受支持的扩展</translation>
    </message>
    <message>
        <source>the JPEG-LS scan header is damaged</source>
        <translation>JPEG-LS 扫描头已损坏</translation>
    </message>
    <message>
        <source>the JPEG-LS coding parameters are out of range</source>
        <translation>JPEG-LS 编码参数超出范围</translation>
    </message>
</context>
<context>
    <name>console::KeyboardMaster</name>
    <message>
        <source>D, held</source>
        <translation>D，按住</translation>
    </message>
    <message>
        <source>dead-man: motion only while it is down</source>
        <translation>握持开关：仅在按住时运动</translation>
    </message>
    <message>
        <source>F, held</source>
        <translation>F，按住</translation>
    </message>
    <message>
        <source>X-ray pedal</source>
        <translation>X 射线踏板</translation>
    </message>
    <message>
        <source>R, held 1.5 s</source>
        <translation>R，按住 1.5 s</translation>
    </message>
    <message>
        <source>arm</source>
        <translation>解锁</translation>
    </message>
    <message>
        <source>U, held 1.5 s</source>
        <translation>U，按住 1.5 s</translation>
    </message>
    <message>
        <source>reset the emergency stop</source>
        <translation>复位急停</translation>
    </message>
    <message>
        <source>Up / Down</source>
        <translation>上 / 下</translation>
    </message>
    <message>
        <source>advance / retract the guidewire</source>
        <translation>推进 / 后撤导丝</translation>
    </message>
    <message>
        <source>Right / Left</source>
        <translation>右 / 左</translation>
    </message>
    <message>
        <source>turn the guidewire clockwise / counter-clockwise</source>
        <translation>顺时针 / 逆时针旋转导丝</translation>
    </message>
    <message>
        <source>I / K</source>
        <translation>I / K</translation>
    </message>
    <message>
        <source>advance / retract the catheter</source>
        <translation>推进 / 后撤导管</translation>
    </message>
    <message>
        <source>L / J</source>
        <translation>L / J</translation>
    </message>
    <message>
        <source>turn the catheter clockwise / counter-clockwise</source>
        <translation>顺时针 / 逆时针旋转导管</translation>
    </message>
    <message>
        <source>C, held</source>
        <translation>C，按住</translation>
    </message>
    <message>
        <source>clutch: the hand moves, the robot does not</source>
        <translation>离合：主手动，机器人不动</translation>
    </message>
    <message>
        <source>Page Up / Page Down</source>
        <translation>Page Up / Page Down</translation>
    </message>
    <message>
        <source>larger / smaller scale; never larger while engaged</source>
        <translation>增大 / 减小运动比例；随动时绝不增大</translation>
    </message>
    <message>
        <source>G, held 1 s</source>
        <translation>G，按住 1 s</translation>
    </message>
    <message>
        <source>inject contrast, while armed</source>
        <translation>注射造影剂（仅在已解锁时）</translation>
    </message>
    <message>
        <source>D dead-man · F X-ray · R arm · G inject · arrows guidewire · I K J L catheter · C clutch · Page Up/Down scale</source>
        <translation>D 握持开关 · F X 射线 · R 解锁 · G 注射 · 方向键 导丝 · I K J L 导管 · C 离合 · Page Up/Down 运动比例</translation>
    </message>
</context>
<context>
    <name>console::LayoutBook</name>
    <message>
        <source>%1 cannot be read as layouts of screens. There are none until one is saved.</source>
        <translation>无法将 %1 读作屏幕布局。在保存布局之前没有任何布局。</translation>
    </message>
    <message>
        <source>%1 is not understood at byte %2: %3. There are no layouts until one is saved.</source>
        <translation>%1 在第 %2 字节处无法理解：%3。在保存布局之前没有任何布局。</translation>
    </message>
    <message>
        <source>no list of layouts</source>
        <translation>不是布局列表</translation>
    </message>
    <message>
        <source>%1: layout %2 makes no sense and is left out.</source>
        <translation>%1：布局 %2 无意义，已略去。</translation>
    </message>
    <message>
        <source>A layout needs a name.</source>
        <translation>布局须有名称。</translation>
    </message>
    <message>
        <source>There are %1 layouts already. Delete one first.</source>
        <translation>已有 %1 个布局。请先删除一个。</translation>
    </message>
    <message>
        <source>This run has no file of layouts: the layout lasts for this run only.</source>
        <translation>本次运行没有布局文件：该布局仅在本次运行中有效。</translation>
    </message>
    <message>
        <source>%1 was not understood, and no copy of it can be kept. Nothing was written; move it away.</source>
        <translation>%1 无法理解，也无法保留其副本。未写入任何内容；请将其移走。</translation>
    </message>
    <message>
        <source>%1 cannot be written: %2. The layout lasts for this run only.</source>
        <translation>无法写入 %1：%2。该布局仅在本次运行中有效。</translation>
    </message>
</context>
<context>
    <name>console::LibraryWords</name>
    <message>
        <source>The attempt ended without a word from the other side.</source>
        <translation>尝试已结束，对方没有任何应答。</translation>
    </message>
    <message>
        <source>The other device does not find this one in its topology: give both the same topology file.</source>
        <translation>对方设备在其拓扑中找不到本设备：请让双方使用同一个拓扑文件。</translation>
    </message>
    <message>
        <source>The topology has no link between the two devices: add it and give every device the same file.</source>
        <translation>拓扑中没有这两台设备之间的链路：请添加，并让每台设备使用同一个文件。</translation>
    </message>
    <message>
        <source>The two devices hold different topology files: give both the same bytes and restart them.</source>
        <translation>两台设备的拓扑文件不同：请让双方使用完全相同的文件并重新启动。</translation>
    </message>
    <message>
        <source>The two devices speak different versions of the protocol: update the older one.</source>
        <translation>两台设备的协议版本不同：请更新较旧的一台。</translation>
    </message>
    <message>
        <source>A message set does not hold what its device type needs: check the file with `liena check`.</source>
        <translation>报文集缺少该设备类型所需的内容：请用 `liena check` 检查该文件。</translation>
    </message>
    <message>
        <source>The link is in stand-by: a person has to re-open it.</source>
        <translation>链路处于待机：必须由人重新打开。</translation>
    </message>
    <message>
        <source>An opening or closing with this device is in hand: wait a moment and try again.</source>
        <translation>与该设备的打开或关闭正在进行：请稍候再试。</translation>
    </message>
    <message>
        <source>One side broke the protocol: note the versions of both programs and report it.</source>
        <translation>其中一方违反了协议：请记下两个程序的版本并报告。</translation>
    </message>
    <message>
        <source>The dialogue did not end in time: the other program is overloaded or stuck.</source>
        <translation>对话未能按时结束：对方程序过载或停止响应。</translation>
    </message>
    <message>
        <source>The other program is stopping: start it again.</source>
        <translation>对方程序正在停止：请重新启动它。</translation>
    </message>
    <message>
        <source>The device is in a session already: look for a second program with the same identity.</source>
        <translation>该设备已在会话中：请查找使用同一身份的另一个程序。</translation>
    </message>
    <message>
        <source>The device shows another message set than the one accepted for its type: a person has to read the changes and accept it (liena sets accept).</source>
        <translation>该设备出示的报文集与其类型已接受的不同：必须由人阅读改动并接受（liena sets accept）。</translation>
    </message>
    <message>
        <source>One of the two devices begins no session until that is mended: see the detail, or its log.</source>
        <translation>在修复之前，其中一台设备不会开始会话：请看详情或其日志。</translation>
    </message>
    <message>
        <source>No probe was made yet.</source>
        <translation>尚未探测。</translation>
    </message>
    <message>
        <source>This computer has no network there: plug, cable and switch at this side.</source>
        <translation>本计算机在该处没有网络：请检查本端的插头、网线和交换机。</translation>
    </message>
    <message>
        <source>The network is up and knows no way to the device: gateway and VPN.</source>
        <translation>网络正常，但没有到该设备的路由：请检查网关和 VPN。</translation>
    </message>
    <message>
        <source>The device&apos;s computer does not answer: its power and cable, or the site&apos;s line.</source>
        <translation>该设备的计算机无应答：请检查其电源和网线，或该院区的线路。</translation>
    </message>
    <message>
        <source>The computer answers and its program is not running: start the program at the patient side.</source>
        <translation>计算机有应答，但其程序没有运行：请在患者端启动该程序。</translation>
    </message>
    <message>
        <source>The device answered and an identity was refused: do not bypass this, call service.</source>
        <translation>该设备有应答，但身份被拒绝：不要绕过，请联系技术服务。</translation>
    </message>
    <message>
        <source>The device accepts connections and says nothing: its program hangs or is overloaded; wait 2 s, then restart it.</source>
        <translation>该设备接受连接但无应答：其程序停止响应或过载；请等待 2 s，然后重新启动它。</translation>
    </message>
    <message>
        <source>The device answers again: the channel can be re-opened.</source>
        <translation>该设备重新应答：可以重新打开通道。</translation>
    </message>
    <message>
        <source>invalid argument</source>
        <translation>参数无效</translation>
    </message>
    <message>
        <source>file unreadable</source>
        <translation>文件无法读取</translation>
    </message>
    <message>
        <source>file unwritable</source>
        <translation>文件无法写入</translation>
    </message>
    <message>
        <source>XML invalid</source>
        <translation>XML 无效</translation>
    </message>
    <message>
        <source>message set invalid</source>
        <translation>报文集无效</translation>
    </message>
    <message>
        <source>topology invalid</source>
        <translation>拓扑无效</translation>
    </message>
    <message>
        <source>certificate invalid</source>
        <translation>证书无效</translation>
    </message>
    <message>
        <source>address unavailable</source>
        <translation>地址不可用</translation>
    </message>
    <message>
        <source>network failure</source>
        <translation>网络故障</translation>
    </message>
    <message>
        <source>unknown device</source>
        <translation>未知设备</translation>
    </message>
    <message>
        <source>unknown message</source>
        <translation>未知报文</translation>
    </message>
    <message>
        <source>no link</source>
        <translation>没有链路</translation>
    </message>
    <message>
        <source>not open</source>
        <translation>未打开</translation>
    </message>
    <message>
        <source>not yet</source>
        <translation>时候未到</translation>
    </message>
    <message>
        <source>stand-by</source>
        <translation>待机</translation>
    </message>
    <message>
        <source>no incident</source>
        <translation>无事件</translation>
    </message>
    <message>
        <source>busy</source>
        <translation>忙</translation>
    </message>
    <message>
        <source>forbidden</source>
        <translation>不允许</translation>
    </message>
    <message>
        <source>value refused</source>
        <translation>数值被拒绝</translation>
    </message>
    <message>
        <source>queue full</source>
        <translation>队列已满</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>已停止</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
</context>
<context>
    <name>console::LinkCard</name>
    <message>
        <source>Link to %1</source>
        <translation>到 %1 的链路</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>打开</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Re-open</source>
        <translation>重新打开</translation>
    </message>
    <message>
        <source>%1 the link to %2</source>
        <translation>%1到 %2 的链路</translation>
    </message>
    <message>
        <source>out</source>
        <translation>发</translation>
    </message>
    <message>
        <source>in</source>
        <translation>收</translation>
    </message>
    <message>
        <source>ms</source>
        <translation>ms</translation>
    </message>
    <message>
        <source>Heard ago</source>
        <translation>上次收到</translation>
    </message>
    <message>
        <source>—</source>
        <translation>—</translation>
    </message>
    <message>
        <source>Round trip</source>
        <translation>往返</translation>
    </message>
    <message>
        <source>Jitter</source>
        <translation>抖动</translation>
    </message>
    <message>
        <source>Loss so far</source>
        <translation>累计丢失率</translation>
    </message>
    <message>
        <source>%</source>
        <translation>%</translation>
    </message>
</context>
<context>
    <name>console::LinkRow</name>
    <message>
        <source>Open</source>
        <translation>打开</translation>
    </message>
    <message>
        <source>%1, for %2</source>
        <translation>%1，已 %2</translation>
    </message>
    <message>
        <source>not opened: %1</source>
        <translation>未打开：%1</translation>
    </message>
    <message>
        <source>%1; not re-opened: %2</source>
        <translation>%1；未重新打开：%2</translation>
    </message>
    <message>
        <source>%1, took %2</source>
        <translation>%1，用时 %2</translation>
    </message>
    <message>
        <source>ms</source>
        <translation>ms</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Re-open</source>
        <translation>重新打开</translation>
    </message>
    <message>
        <source>%1 the link to %2</source>
        <translation>%1到 %2 的链路</translation>
    </message>
</context>
<context>
    <name>console::LinksRail</name>
    <message>
        <source>Links</source>
        <translation>链路</translation>
    </message>
    <message>
        <source>Open all</source>
        <translation>全部打开</translation>
    </message>
    <message>
        <source>Topology  F2</source>
        <translation>拓扑  F2</translation>
    </message>
    <message>
        <source>Links of this console</source>
        <translation>本控制台的链路</translation>
    </message>
    <message>
        <source>Open all closed links, one after the other</source>
        <translation>依次打开所有已关闭的链路</translation>
    </message>
    <message>
        <source>Show the topology</source>
        <translation>显示拓扑</translation>
    </message>
    <message>
        <source>Link cards</source>
        <translation>链路卡片</translation>
    </message>
    <message>
        <source>No links</source>
        <translation>无链路</translation>
    </message>
    <message>
        <source>%1 of %2 open</source>
        <translation>已打开 %1/%2</translation>
    </message>
</context>
<context>
    <name>console::LiveImageView</name>
    <message>
        <source>Live X-ray image</source>
        <translation>实时 X 射线图像</translation>
    </message>
    <message>
        <source>Frame %1 is refused: %2.</source>
        <translation>第 %1 帧被拒绝：%2。</translation>
    </message>
    <message>
        <source>No picture yet</source>
        <translation>尚无图像</translation>
    </message>
    <message>
        <source>Open the link to the X-ray system and press its pedal.</source>
        <translation>请打开到 X 射线系统的链路，并踩下其踏板。</translation>
    </message>
    <message>
        <source>%1 %2.</source>
        <translation>%1 %2。</translation>
    </message>
    <message>
        <source>The picture is live.</source>
        <translation>图像是实时的。</translation>
    </message>
    <message>
        <source>Pictures come, but their age is unknown.</source>
        <translation>有图像到达，但时龄未知。</translation>
    </message>
    <message>
        <source>The picture is frozen; it was taken at %1.</source>
        <translation>图像已冻结；拍摄于 %1。</translation>
    </message>
    <message>
        <source>Last image hold; the picture was taken at %1.</source>
        <translation>末帧保持；图像拍摄于 %1。</translation>
    </message>
    <message>
        <source>No picture yet.</source>
        <translation>尚无图像。</translation>
    </message>
</context>
<context>
    <name>console::LogFilter</name>
    <message>
        <source>of the chosen kinds there is none</source>
        <translation>所选类别均无</translation>
    </message>
    <message>
        <source># LiENa console, %1, written %2
</source>
        <translation># LiENa 控制台，%1，写于 %2
</translation>
    </message>
    <message>
        <source># %1 of %2 lines
</source>
        <translation># %2 行中的 %1 行
</translation>
    </message>
    <message>
        <source># kinds: %1
</source>
        <translation># 类别：%1
</translation>
    </message>
    <message>
        <source># with the words: %1
</source>
        <translation># 含有文字：%1
</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
</context>
<context>
    <name>console::LogReview</name>
    <message>
        <source>Review from the log</source>
        <translation>从日志回放</translation>
    </message>
    <message>
        <source>Review this moment</source>
        <translation>回放此刻</translation>
    </message>
    <message>
        <source>Review the picture of the chosen line&apos;s moment</source>
        <translation>回放所选行时刻的图像</translation>
    </message>
    <message>
        <source>One picture back</source>
        <translation>后退一幅</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>播放</translation>
    </message>
    <message>
        <source>One picture on</source>
        <translation>前进一幅</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>Stop the film</source>
        <translation>停止播放</translation>
    </message>
    <message>
        <source>▶ is before the last line up to the picture in review.</source>
        <translation>▶ 标出截至回放图像时刻的最后一行。</translation>
    </message>
    <message>
        <source>No picture came at this moment, nor shortly before it.</source>
        <translation>此刻及之前不久没有图像到达。</translation>
    </message>
    <message>
        <source>No picture of this moment is kept: the last %1 s of pictures are.</source>
        <translation>未保留此刻的图像：只保留最近 %1 s 的图像。</translation>
    </message>
    <message>
        <source>No picture of this moment is kept.</source>
        <translation>未保留此刻的图像。</translation>
    </message>
</context>
<context>
    <name>console::LogSaver</name>
    <message>
        <source>No file is named. Write the name of one, for example %1.</source>
        <translation>未指定文件。请写出文件名，例如 %1。</translation>
    </message>
    <message>
        <source>%1 is there already and stays as it is. Name another file.</source>
        <translation>%1 已存在，保持不变。请指定另一个文件。</translation>
    </message>
    <message>
        <source>The folder %1 cannot be made. Name a file in another one.</source>
        <translation>无法创建文件夹 %1。请指定其他文件夹中的文件。</translation>
    </message>
    <message>
        <source>%1 cannot be written: %2. Nothing was saved; make room on the disk or name a file in another folder.</source>
        <translation>无法写入 %1：%2。未保存任何内容；请腾出磁盘空间，或指定其他文件夹中的文件。</translation>
    </message>
    <message>
        <source>A log is still being written. Save again when it is done.</source>
        <translation>日志仍在写入。完成后请再次保存。</translation>
    </message>
</context>
<context>
    <name>console::LogView</name>
    <message>
        <source>Log view</source>
        <translation>日志视图</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>日志</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>运行记录</translation>
    </message>
    <message>
        <source>Show the event log of this run</source>
        <translation>显示本次的运行日志</translation>
    </message>
    <message>
        <source>Alarms</source>
        <translation>报警</translation>
    </message>
    <message>
        <source>Show the alarm log, with what was kept of earlier runs</source>
        <translation>显示报警日志，含以前运行所保留的部分</translation>
    </message>
    <message>
        <source>To the cockpit  F1</source>
        <translation>到驾驶舱  F1</translation>
    </message>
    <message>
        <source>Only</source>
        <translation>只显示</translation>
    </message>
    <message>
        <source>Only lines with these words</source>
        <translation>只显示含这些文字的行</translation>
    </message>
    <message>
        <source>with these words</source>
        <translation>含这些文字</translation>
    </message>
    <message>
        <source>Into the file</source>
        <translation>写入文件</translation>
    </message>
    <message>
        <source>File that the lines shown are written into</source>
        <translation>所显示的行要写入的文件</translation>
    </message>
    <message>
        <source>Save lines shown</source>
        <translation>保存所显示的行</translation>
    </message>
    <message>
        <source>Write the lines shown into the file</source>
        <translation>将所显示的行写入文件</translation>
    </message>
    <message>
        <source>Event log, oldest first</source>
        <translation>运行日志，最早的在前</translation>
    </message>
    <message>
        <source>Alarm log, oldest first</source>
        <translation>报警日志，最早的在前</translation>
    </message>
    <message>
        <source>Only lines of the kind: %1</source>
        <translation>只显示此类别的行：%1</translation>
    </message>
    <message>
        <source>%1 lines</source>
        <translation>%1 行</translation>
    </message>
    <message>
        <source>%1 of %2 lines</source>
        <translation>%2 行中的 %1 行</translation>
    </message>
    <message>
        <source>; %1 older ones are gone</source>
        <translation>；更早的 %1 行已不在</translation>
    </message>
    <message>
        <source>Choose a line to read it whole.</source>
        <translation>选择一行以阅读全文。</translation>
    </message>
    <message>
        <source>Writing…</source>
        <translation>正在写入…</translation>
    </message>
    <message>
        <source>event log of this run</source>
        <translation>本次的运行日志</translation>
    </message>
    <message>
        <source>alarm log</source>
        <translation>报警日志</translation>
    </message>
    <message>
        <source>Saved: %1</source>
        <translation>已保存：%1</translation>
    </message>
    <message>
        <source>Leave the log</source>
        <translation>离开日志</translation>
    </message>
</context>
<context>
    <name>console::LoginSession</name>
    <message>
        <source>it is not there</source>
        <translation>它未运行</translation>
    </message>
    <message>
        <source>what it answers makes no sense</source>
        <translation>其应答无法理解</translation>
    </message>
    <message>
        <source>this program belongs to no session with a screen</source>
        <translation>本程序不属于任何带屏幕的登录会话</translation>
    </message>
</context>
<context>
    <name>console::Loudspeaker</name>
    <message>
        <source>%1 was not started: %2</source>
        <translation>%1 未能启动：%2</translation>
    </message>
    <message>
        <source>its sound player has ended</source>
        <translation>其声音播放程序已结束</translation>
    </message>
    <message>
        <source>no sound player was named</source>
        <translation>未指定声音播放程序</translation>
    </message>
    <message>
        <source>the sound output does not answer</source>
        <translation>声音输出无应答</translation>
    </message>
</context>
<context>
    <name>console::MasterChip</name>
    <message>
        <source>Master in use: %1, %2</source>
        <translation>正在使用的主手设备：%1，%2</translation>
    </message>
    <message>
        <source>Use %1, %2</source>
        <translation>使用 %1，%2</translation>
    </message>
</context>
<context>
    <name>console::MasterRow</name>
    <message>
        <source>%1 for %2</source>
        <translation>%1，已 %2</translation>
    </message>
    <message>
        <source>Masters</source>
        <translation>主手设备</translation>
    </message>
</context>
<context>
    <name>console::MasterStatus</name>
    <message>
        <source>Keyboard</source>
        <translation>键盘</translation>
    </message>
    <message>
        <source>3-D mouse</source>
        <translation>三维鼠标</translation>
    </message>
    <message>
        <source>Game pad</source>
        <translation>游戏手柄</translation>
    </message>
    <message>
        <source>Haptic, SIMULATED</source>
        <translation>力反馈主手，模拟</translation>
    </message>
    <message>
        <source>RECORDED hand</source>
        <translation>录制的主手动作</translation>
    </message>
    <message>
        <source>gone</source>
        <translation>已移除</translation>
    </message>
    <message>
        <source>silent</source>
        <translation>无应答</translation>
    </message>
    <message>
        <source>not heard</source>
        <translation>未获焦点</translation>
    </message>
    <message>
        <source>let go first</source>
        <translation>请先松开</translation>
    </message>
    <message>
        <source>alive</source>
        <translation>正常</translation>
    </message>
</context>
<context>
    <name>console::Measurement</name>
    <message>
        <source>%1 mm @ isocentre plane (geometry)</source>
        <translation>%1 mm @ 等中心平面（几何）</translation>
    </message>
    <message>
        <source>%1 mm (%2 F catheter)</source>
        <translation>%1 mm（%2 F 导管）</translation>
    </message>
    <message>
        <source>%1 px (uncalibrated)</source>
        <translation>%1 px（未校准）</translation>
    </message>
    <message>
        <source>true in the catheter&apos;s plane only</source>
        <translation>仅在导管所在平面内准确</translation>
    </message>
    <message>
        <source>object 5 cm nearer or farther: ≈ %1 % off</source>
        <translation>物体近或远 5 cm：误差 ≈ %1 %</translation>
    </message>
    <message>
        <source>%1° in the picture&apos;s plane</source>
        <translation>%1°（图像平面内）</translation>
    </message>
    <message>
        <source>no angle: two points are one</source>
        <translation>无角度：两点重合</translation>
    </message>
    <message>
        <source>%1 mm @ table plane + %2 cm (geometry)</source>
        <translation>%1 mm @ 床面 + %2 cm（几何）</translation>
    </message>
    <message>
        <source>%1 px (uncalibrated: no table plane)</source>
        <translation>%1 px（未校准：无床面）</translation>
    </message>
    <message>
        <source>lengths by geometry: table plane + %1 cm</source>
        <translation>几何长度：床面 + %1 cm</translation>
    </message>
    <message>
        <source>lengths by geometry: isocentre plane</source>
        <translation>几何长度：等中心平面</translation>
    </message>
    <message>
        <source>the table&apos;s top is not set up in the preferences</source>
        <translation>首选项中未设置床面高度</translation>
    </message>
    <message>
        <source>the table&apos;s height in this picture is unknown</source>
        <translation>此图像的床高未知</translation>
    </message>
    <message>
        <source>the picture&apos;s geometry is unknown</source>
        <translation>图像的几何参数未知</translation>
    </message>
    <message>
        <source>the beam is more than 60° from upright</source>
        <translation>射线束偏离竖直方向超过 60°</translation>
    </message>
    <message>
        <source>the X-ray source is above the table</source>
        <translation>X 射线源在床的上方</translation>
    </message>
    <message>
        <source>the plane is not between source and detector</source>
        <translation>该平面不在射线源与探测器之间</translation>
    </message>
</context>
<context>
    <name>console::ModeMark</name>
    <message>
        <source>Mode</source>
        <translation>模式</translation>
    </message>
</context>
<context>
    <name>console::MotionBar</name>
    <message>
        <source>Motion</source>
        <translation>运动</translation>
    </message>
    <message>
        <source>Arm: hold for one and a half seconds</source>
        <translation>解锁：按住一秒半</translation>
    </message>
    <message>
        <source>Reset the emergency stop: hold for one and a half seconds</source>
        <translation>复位急停：按住一秒半</translation>
    </message>
    <message>
        <source>RESET STOP</source>
        <translation>复位急停</translation>
    </message>
    <message>
        <source>hold or U, 1.5 s</source>
        <translation>按住或 U 键 1.5 s</translation>
    </message>
    <message>
        <source>another: hold again</source>
        <translation>另有急停：再按住</translation>
    </message>
    <message>
        <source>hold 1.5 s</source>
        <translation>按住 1.5 s</translation>
    </message>
    <message>
        <source>X-ray pedal: fluoroscopy while held</source>
        <translation>X 射线踏板：按住时透视</translation>
    </message>
    <message>
        <source>ARM</source>
        <translation>解锁</translation>
    </message>
    <message>
        <source>asking the robot</source>
        <translation>正在请求机器人</translation>
    </message>
    <message>
        <source>ARMED</source>
        <translation>已解锁</translation>
    </message>
    <message>
        <source>F12 holds</source>
        <translation>F12 保持</translation>
    </message>
    <message>
        <source>not ready</source>
        <translation>未就绪</translation>
    </message>
    <message>
        <source>X-RAY</source>
        <translation>X 射线</translation>
    </message>
    <message>
        <source>beam is on</source>
        <translation>正在出束</translation>
    </message>
    <message>
        <source>beam not seen</source>
        <translation>未见出束</translation>
    </message>
    <message>
        <source>hold to image</source>
        <translation>按住以成像</translation>
    </message>
    <message>
        <source>N</source>
        <translation>N</translation>
    </message>
    <message>
        <source>Accept this force</source>
        <translation>接受此力</translation>
    </message>
    <message>
        <source>You have looked at it: the next arming within 30 s is not refused for it</source>
        <translation>您已查看：30 s 内的下一次解锁不会因此被拒绝</translation>
    </message>
    <message>
        <source>Accept %1</source>
        <translation>接受 %1</translation>
    </message>
    <message>
        <source>Inject contrast: hold for one second while armed</source>
        <translation>注射造影剂：已解锁时按住一秒</translation>
    </message>
    <message>
        <source>no answer</source>
        <translation>无应答</translation>
    </message>
    <message>
        <source>running</source>
        <translation>进行中</translation>
    </message>
    <message>
        <source>too little left</source>
        <translation>余量不足</translation>
    </message>
    <message>
        <source>robot unheard</source>
        <translation>收不到机器人</translation>
    </message>
    <message>
        <source>%1 mL, hold 1 s</source>
        <translation>%1 mL，按住 1 s</translation>
    </message>
    <message>
        <source>not armed</source>
        <translation>未解锁</translation>
    </message>
    <message>
        <source>INJECT</source>
        <translation>注射</translation>
    </message>
    <message>
        <source>observer</source>
        <translation>观察者</translation>
    </message>
</context>
<context>
    <name>console::MotionPermit</name>
    <message>
        <source>OFF</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>STANDBY</source>
        <translation>待命</translation>
    </message>
    <message>
        <source>READY</source>
        <translation>就绪</translation>
    </message>
    <message>
        <source>ARMING</source>
        <translation>正在解锁</translation>
    </message>
    <message>
        <source>ARMED</source>
        <translation>已解锁</translation>
    </message>
    <message>
        <source>ENGAGED</source>
        <translation>随动</translation>
    </message>
    <message>
        <source>HOLD</source>
        <translation>保持</translation>
    </message>
    <message>
        <source>INCIDENT</source>
        <translation>事件</translation>
    </message>
    <message>
        <source>VERIFYING</source>
        <translation>正在核查</translation>
    </message>
    <message>
        <source>a condition for motion was no longer met</source>
        <translation>某项运动条件不再满足</translation>
    </message>
    <message>
        <source>a link is not open any more</source>
        <translation>有链路不再打开</translation>
    </message>
    <message>
        <source>%1 link is not open any more</source>
        <translation>%1 链路不再打开</translation>
    </message>
    <message>
        <source>Hold was asked for, or the window lost the hand</source>
        <translation>有人要求保持，或窗口失去主手输入</translation>
    </message>
    <message>
        <source>this console stood still for longer than 100 ms</source>
        <translation>本控制台停顿超过 100 ms</translation>
    </message>
    <message>
        <source>for a moment the picture was too old, or this console stood still</source>
        <translation>图像曾一度过旧，或本控制台曾停顿</translation>
    </message>
    <message>
        <source>the robot withdrew its permit</source>
        <translation>机器人撤回了许可</translation>
    </message>
    <message>
        <source>the robot did not answer the request to arm</source>
        <translation>机器人未应答解锁请求</translation>
    </message>
</context>
<context>
    <name>console::PermitBlock</name>
    <message>
        <source>Motion permit</source>
        <translation>运动许可</translation>
    </message>
    <message>
        <source>No session with the robot. Open the links.</source>
        <translation>与机器人没有会话。请打开链路。</translation>
    </message>
    <message>
        <source>1 condition is missing</source>
        <translation>1 项条件未满足</translation>
    </message>
    <message>
        <source>%1 conditions are missing</source>
        <translation>%1 项条件未满足</translation>
    </message>
    <message>
        <source>Hold ARM for 1.5 s to arm</source>
        <translation>按住“解锁”1.5 s 以解锁</translation>
    </message>
    <message>
        <source>Waiting for the robot&apos;s answer</source>
        <translation>正在等待机器人应答</translation>
    </message>
    <message>
        <source>Keep holding</source>
        <translation>请继续按住</translation>
    </message>
    <message>
        <source>Release the dead-man, then press it to move</source>
        <translation>请先松开握持开关，再按下以运动</translation>
    </message>
    <message>
        <source>Press the dead-man to move. Ends in %1</source>
        <translation>按下握持开关即可运动。%1 后失效</translation>
    </message>
    <message>
        <source>Instruments follow your hand</source>
        <translation>器械正跟随您的主手</translation>
    </message>
    <message>
        <source>Held because: %1. %2</source>
        <translation>保持原因：%1。%2</translation>
    </message>
    <message>
        <source>Robot not holding yet</source>
        <translation>机器人尚未保持</translation>
    </message>
    <message>
        <source>Release the dead-man</source>
        <translation>请松开握持开关</translation>
    </message>
    <message>
        <source>The robot holds</source>
        <translation>机器人保持中</translation>
    </message>
    <message>
        <source>Stand-by: a link is lost</source>
        <translation>待机：有链路丢失</translation>
    </message>
    <message>
        <source>Re-opened. Checking for 1 s</source>
        <translation>已重新打开。核查 1 s</translation>
    </message>
    <message>
        <source>Re-opened. 1 condition is missing</source>
        <translation>已重新打开。1 项条件未满足</translation>
    </message>
    <message>
        <source>Re-opened. %1 conditions are missing</source>
        <translation>已重新打开。%1 项条件未满足</translation>
    </message>
</context>
<context>
    <name>console::PictureCanvas</name>
    <message>
        <source>Measuring %1: set %2 points</source>
        <translation>测量%1：请设 %2 个点</translation>
    </message>
    <message>
        <source>Catheter, right button or B: it is the width of a catheter of 4 F to 8 F</source>
        <translation>“导管”、右键或 B：此为 4 F 至 8 F 导管的宽度</translation>
    </message>
    <message>
        <source>Plane or O: isocentre or table plane</source>
        <translation>“平面”或 O：等中心平面或床面</translation>
    </message>
    <message>
        <source>First set two points, as far from each other as the catheter is wide.</source>
        <translation>请先设两个点，其间距等于导管的宽度。</translation>
    </message>
</context>
<context>
    <name>console::PictureControls</name>
    <message>
        <source>Picture controls</source>
        <translation>图像控制</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>测量</translation>
    </message>
    <message>
        <source>Less %1</source>
        <translation>减小%1</translation>
    </message>
    <message>
        <source>More %1</source>
        <translation>增大%1</translation>
    </message>
    <message>
        <source>AUTO</source>
        <translation>自动</translation>
    </message>
    <message>
        <source>Automatic window</source>
        <translation>自动窗</translation>
    </message>
    <message>
        <source>Window from the 1st to the 99th percentile (A)</source>
        <translation>窗从第 1 到第 99 百分位 (A)</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>调窗</translation>
    </message>
    <message>
        <source>Next window</source>
        <translation>下一个窗</translation>
    </message>
    <message>
        <source>As sent, full range, half width, twice the width (P)</source>
        <translation>原始窗、全范围、窗宽减半、窗宽加倍 (P)</translation>
    </message>
    <message>
        <source>Invert</source>
        <translation>反相</translation>
    </message>
    <message>
        <source>Black and white changed over (N)</source>
        <translation>黑白互换 (N)</translation>
    </message>
    <message>
        <source>zoom</source>
        <translation>缩放</translation>
    </message>
    <message>
        <source>noise reduction</source>
        <translation>降噪</translation>
    </message>
    <message>
        <source>edge enhancement</source>
        <translation>边缘增强</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>复位</translation>
    </message>
    <message>
        <source>Reset picture</source>
        <translation>复位图像</translation>
    </message>
    <message>
        <source>Whole picture, window as sent, no filters</source>
        <translation>整幅图像，原始窗，无滤波</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>电子遮光</translation>
    </message>
    <message>
        <source>None, round, square (H)</source>
        <translation>无、圆形、方形 (H)</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>角度</translation>
    </message>
    <message>
        <source>Distance, angle, off (M)</source>
        <translation>距离、角度、关闭 (M)</translation>
    </message>
    <message>
        <source>Catheter</source>
        <translation>导管</translation>
    </message>
    <message>
        <source>Width of a catheter</source>
        <translation>导管宽度</translation>
    </message>
    <message>
        <source>The distance is the width of a catheter: 4 F to 8 F, none (B)</source>
        <translation>该距离为导管的宽度：4 F 至 8 F、无 (B)</translation>
    </message>
    <message>
        <source>Plane</source>
        <translation>平面</translation>
    </message>
    <message>
        <source>Plane of lengths</source>
        <translation>长度所在平面</translation>
    </message>
    <message>
        <source>Lengths at the isocentre, or in a plane above the table (O)</source>
        <translation>长度按等中心平面，或按床面上方的平面 (O)</translation>
    </message>
    <message>
        <source>%1 cm above the table</source>
        <translation>床面上方 %1 cm</translation>
    </message>
    <message>
        <source>at the isocentre</source>
        <translation>在等中心</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Save picture</source>
        <translation>保存图像</translation>
    </message>
    <message>
        <source>As PNG and as DICOM Secondary Capture</source>
        <translation>存为 PNG 和 DICOM Secondary Capture</translation>
    </message>
    <message>
        <source>%1×</source>
        <translation>%1×</translation>
    </message>
    <message>
        <source>noise %1</source>
        <translation>降噪 %1</translation>
    </message>
    <message>
        <source>edge %1</source>
        <translation>边缘 %1</translation>
    </message>
</context>
<context>
    <name>console::PictureDesk</name>
    <message>
        <source>there is nothing to review yet</source>
        <translation>尚无可回放的内容</translation>
    </message>
    <message>
        <source>no run has ended yet: there is no last image</source>
        <translation>尚无序列结束：没有末帧</translation>
    </message>
    <message>
        <source>there is no picture to save yet</source>
        <translation>尚无可保存的图像</translation>
    </message>
    <message>
        <source>picture saved: %1</source>
        <translation>图像已保存：%1</translation>
    </message>
    <message>
        <source>roadmap removed: %1</source>
        <translation>路图已移除：%1</translation>
    </message>
    <message>
        <source>no roadmap: no run has shown contrast yet; give contrast while the pedal is down</source>
        <translation>无路图：还没有哪个序列显示造影剂；请在踩下踏板时注射造影剂</translation>
    </message>
    <message>
        <source>no roadmap: it was removed, and no contrast was given since</source>
        <translation>无路图：已被移除，此后未再注射造影剂</translation>
    </message>
    <message>
        <source>roadmap made of %1 pictures of run %2</source>
        <translation>路图由序列 %2 的 %1 帧图像制成</translation>
    </message>
    <message>
        <source>no picture of that moment is kept any more</source>
        <translation>那一刻的图像已不再保留</translation>
    </message>
</context>
<context>
    <name>console::PictureExport</name>
    <message>
        <source>SNAPSHOT</source>
        <translation>快照</translation>
    </message>
    <message>
        <source>picture of %1</source>
        <translation>图像时刻 %1</translation>
    </message>
    <message>
        <source>%1 cannot be written: %2. Nothing was saved; make room on the disk or name another folder.</source>
        <translation>无法写入 %1：%2。未保存任何内容；请腾出磁盘空间或指定其他文件夹。</translation>
    </message>
    <message>
        <source>%1 cannot be written: there is no picture, or no memory for it. Save again.</source>
        <translation>无法写入 %1：没有图像或内存不足。请再次保存。</translation>
    </message>
    <message>
        <source>%1 cannot be written: there is no picture. Save again when one is shown.</source>
        <translation>无法写入 %1：没有图像。请在显示图像后再次保存。</translation>
    </message>
    <message>
        <source>%1 cannot be written: the picture could not be encoded as DICOM. Save it as PNG.</source>
        <translation>无法写入 %1：图像无法编码为 DICOM。请存为 PNG。</translation>
    </message>
</context>
<context>
    <name>console::PictureMarks</name>
    <message>
        <source>noise %1 %</source>
        <translation>降噪 %1 %</translation>
    </message>
    <message>
        <source>noise %1 of %2 %, for latency</source>
        <translation>降噪 %1/%2 %，因时延受限</translation>
    </message>
    <message>
        <source>noise %1 of %2 %</source>
        <translation>降噪 %1/%2 %</translation>
    </message>
    <message>
        <source>C %1  W %2</source>
        <translation>C %1  W %2</translation>
    </message>
    <message>
        <source>  AUTO</source>
        <translation>  自动</translation>
    </message>
    <message>
        <source>INVERTED</source>
        <translation>反相</translation>
    </message>
    <message>
        <source>edge %1 %, %2</source>
        <translation>边缘 %1 %，%2</translation>
    </message>
    <message>
        <source>SHUTTER</source>
        <translation>电子遮光</translation>
    </message>
    <message>
        <source>display calibrated</source>
        <translation>显示器已校准</translation>
    </message>
    <message>
        <source>display not calibrated</source>
        <translation>显示器未校准</translation>
    </message>
    <message>
        <source>sides unknown</source>
        <translation>左右未知</translation>
    </message>
    <message>
        <source>no scale: geometry unknown</source>
        <translation>无标尺：几何未知</translation>
    </message>
    <message>
        <source>%1 mm @ isocentre plane (geometry)</source>
        <translation>%1 mm @ 等中心平面（几何）</translation>
    </message>
    <message>
        <source>%1 mm @ isocentre</source>
        <translation>%1 mm @ 等中心</translation>
    </message>
    <message>
        <source>frame %1  run %2</source>
        <translation>帧 %1  序列 %2</translation>
    </message>
    <message>
        <source>ZOOM %1×</source>
        <translation>缩放 %1×</translation>
    </message>
    <message>
        <source>MEAN OF %1</source>
        <translation>%1 帧平均</translation>
    </message>
</context>
<context>
    <name>console::PictureOverlay</name>
    <message>
        <source>unknown</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 ±%2 ms</source>
        <translation>%1 ±%2 ms</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source> %1 s</source>
        <translation> %1 s</translation>
    </message>
    <message>
        <source>Picture of %1</source>
        <translation>图像时刻 %1</translation>
    </message>
    <message>
        <source>AGE %1  NET %2  PROC %3  %4</source>
        <translation>时龄 %1  网络 %2  处理 %3  %4</translation>
    </message>
    <message>
        <source>%1 of %2 fps</source>
        <translation>%1/%2 fps</translation>
    </message>
    <message>
        <source>%1 fps</source>
        <translation>%1 fps</translation>
    </message>
    <message>
        <source>AGE 8888 ±88 ms  NET 888  PROC 888  88 of 88 fps</source>
        <translation>时龄 8888 ±88 ms  网络 888  处理 888  88/88 fps</translation>
    </message>
</context>
<context>
    <name>console::PictureReduction</name>
    <message>
        <source>REDUCED</source>
        <translation>已降级</translation>
    </message>
    <message>
        <source>RE-ENCODED</source>
        <translation>已改编码</translation>
    </message>
    <message>
        <source>%1 %2 of %3 /s</source>
        <translation>%1 %2，要求 %3 /s</translation>
    </message>
    <message>
        <source>raw</source>
        <translation>未压缩</translation>
    </message>
    <message>
        <source>lossless</source>
        <translation>无损</translation>
    </message>
    <message>
        <source>lossy by at most %1</source>
        <translation>有损，误差至多 %1</translation>
    </message>
    <message>
        <source>lossy %1</source>
        <translation>有损 %1</translation>
    </message>
    <message>
        <source>encoding %1</source>
        <translation>编码 %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
</context>
<context>
    <name>console::PictureSaver</name>
    <message>
        <source>A picture is still being saved. Save again when it is done.</source>
        <translation>图像仍在保存。完成后请再次保存。</translation>
    </message>
    <message>
        <source>The folder %1 cannot be made. Name another one with --pictures or in the preferences (Ctrl+,).</source>
        <translation>无法创建文件夹 %1。请用 --pictures 或在首选项 (Ctrl+,) 中指定另一个。</translation>
    </message>
</context>
<context>
    <name>console::PictureStages</name>
    <message>
        <source>before sending</source>
        <translation>发送之前</translation>
    </message>
    <message>
        <source>way to here</source>
        <translation>传到本端</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>等待</translation>
    </message>
    <message>
        <source>decoding</source>
        <translation>解码</translation>
    </message>
    <message>
        <source>filters</source>
        <translation>滤波</translation>
    </message>
    <message>
        <source>window</source>
        <translation>窗宽窗位</translation>
    </message>
    <message>
        <source>filter&apos;s delay</source>
        <translation>滤波延迟</translation>
    </message>
</context>
<context>
    <name>console::PlotsView</name>
    <message>
        <source>To the cockpit  F1</source>
        <translation>到驾驶舱  F1</translation>
    </message>
    <message>
        <source>Plots</source>
        <translation>曲线</translation>
    </message>
    <message>
        <source>Leave the plots</source>
        <translation>离开曲线</translation>
    </message>
    <message>
        <source>Where the picture&apos;s age comes from: median and 99th percentile of the last minute</source>
        <translation>图像时龄的来源：最近一分钟的中位数和第 99 百分位</translation>
    </message>
    <message>
        <source>60 s, median</source>
        <translation>60 s，中位数</translation>
    </message>
    <message>
        <source>60 s, 99 %</source>
        <translation>60 s，99 %</translation>
    </message>
    <message>
        <source>10 min, median</source>
        <translation>10 min，中位数</translation>
    </message>
    <message>
        <source>10 min, 99 %</source>
        <translation>10 min，99 %</translation>
    </message>
    <message>
        <source>How the figures lay; over ten minutes the largest of each second</source>
        <translation>数值分布；十分钟内取每秒最大值</translation>
    </message>
</context>
<context>
    <name>console::PreferenceDesk</name>
    <message>
        <source>Read only: the permit is %1. Preferences can be changed when nothing is armed or in hold.</source>
        <translation>只读：许可为 %1。在未解锁且未保持时才能更改首选项。</translation>
    </message>
    <message>
        <source>This run has no file of preferences: it begins with the defaults, and changes are not kept.</source>
        <translation>本次运行没有首选项文件：以默认值开始，更改不予保存。</translation>
    </message>
    <message>
        <source>For this run the command line decides on the folder of pictures: %1.</source>
        <translation>本次运行由命令行决定图像文件夹：%1。</translation>
    </message>
</context>
<context>
    <name>console::PreferenceStore</name>
    <message>
        <source>%1 to %2</source>
        <translation>%1 到 %2</translation>
    </message>
    <message>
        <source>%1: %2 is &apos;%3&apos;, which is none of: %4. The default is used.</source>
        <translation>%1：%2 为“%3”，不属于：%4。使用默认值。</translation>
    </message>
    <message>
        <source>the name of a folder</source>
        <translation>文件夹名称</translation>
    </message>
    <message>
        <source>the name of a folder, in quotes when it has a comma</source>
        <translation>文件夹名称，含逗号时须加引号</translation>
    </message>
    <message>
        <source>%1 is not a file. The defaults are used.</source>
        <translation>%1 不是文件。使用默认值。</translation>
    </message>
    <message>
        <source>%1 is too long for preferences (%2 bytes). The defaults are used.</source>
        <translation>%1 对首选项来说过长（%2 字节）。使用默认值。</translation>
    </message>
    <message>
        <source>%1 cannot be read: %2. The defaults are used.</source>
        <translation>无法读取 %1：%2。使用默认值。</translation>
    </message>
    <message>
        <source>%1 is not a file of preferences. The defaults are used.</source>
        <translation>%1 不是首选项文件。使用默认值。</translation>
    </message>
    <message>
        <source>%1 cannot be read as a whole: what was not understood has its default.</source>
        <translation>%1 无法完整读取：无法理解的部分使用默认值。</translation>
    </message>
    <message>
        <source>%1 was not understood, and no copy of it can be kept beside it. Nothing was written; move it away.</source>
        <translation>%1 无法理解，也无法在其旁保留副本。未写入任何内容；请将其移走。</translation>
    </message>
    <message>
        <source>%1 cannot be written: this choice lasts for this run only. Look at the folder&apos;s permissions and the disk.</source>
        <translation>无法写入 %1：此选择仅在本次运行中有效。请检查文件夹权限和磁盘。</translation>
    </message>
    <message>
        <source>one short line</source>
        <translation>一行短文字</translation>
    </message>
</context>
<context>
    <name>console::Preferences</name>
    <message>
        <source>dim</source>
        <translation>暗</translation>
    </message>
    <message>
        <source>usual</source>
        <translation>标准</translation>
    </message>
    <message>
        <source>bright</source>
        <translation>亮</translation>
    </message>
</context>
<context>
    <name>console::PreferencesView</name>
    <message>
        <source>as the computer</source>
        <translation>与计算机相同</translation>
    </message>
    <message>
        <source>To the cockpit  F1</source>
        <translation>到驾驶舱  F1</translation>
    </message>
    <message>
        <source>About</source>
        <translation>关于</translation>
    </message>
    <message>
        <source>Restore defaults</source>
        <translation>恢复默认值</translation>
    </message>
    <message>
        <source>Preferences</source>
        <translation>首选项</translation>
    </message>
    <message>
        <source>Entries</source>
        <translation>条目</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>语言</translation>
    </message>
    <message>
        <source>Of everything on this screen. Takes effect when the console is started next.</source>
        <translation>本屏幕全部内容的语言。下次启动控制台时生效。</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>亮度</translation>
    </message>
    <message>
        <source>Of what surrounds the pictures. The pictures and the alarms&apos; colours are the same in each.</source>
        <translation>图像周围部分的亮度。各档中图像和报警颜色均相同。</translation>
    </message>
    <message>
        <source>Audio pause</source>
        <translation>报警声暂停</translation>
    </message>
    <message>
        <source>How long F9 silences alarms. A new high alarm ends it; 120 s is the site&apos;s limit.</source>
        <translation>F9 使报警静音的时长。新的高优先级报警会结束暂停；120 s 为院区上限。</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Trends</source>
        <translation>趋势</translation>
    </message>
    <message>
        <source>The span that the trends begin with; their own button changes it at any time.</source>
        <translation>趋势开始时的时间跨度；随时可用其按钮更改。</translation>
    </message>
    <message>
        <source>60 s</source>
        <translation>60 s</translation>
    </message>
    <message>
        <source>10 min</source>
        <translation>10 min</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>调窗</translation>
    </message>
    <message>
        <source>Brightness and contrast that pictures begin with. The picture&apos;s own controls change it.</source>
        <translation>图像开始时的亮度和对比度。可用图像自身的控件更改。</translation>
    </message>
    <message>
        <source>Noise reduction</source>
        <translation>降噪</translation>
    </message>
    <message>
        <source>That pictures begin with. It mixes pictures of before in, so movement is shown later; the age counts it, and less is mixed in where the age limit leaves no room.</source>
        <translation>图像开始时的降噪。它混入先前的图像，因此运动显示得更晚；时龄已将其计入，时龄上限不留余地时混入较少。</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>边缘</translation>
    </message>
    <message>
        <source>Enhancement of edges that pictures begin with.</source>
        <translation>图像开始时的边缘增强。</translation>
    </message>
    <message>
        <source>Folder of pictures</source>
        <translation>图像文件夹</translation>
    </message>
    <message>
        <source>liena, in your folder of pictures</source>
        <translation>您的图片文件夹中的 liena</translation>
    </message>
    <message>
        <source>Where “Save” under a picture writes to; Enter takes it. It is made when it is missing.</source>
        <translation>图像下方“保存”写入的位置；按 Enter 采用。不存在时会自动创建。</translation>
    </message>
    <message>
        <source>About this software and its parts</source>
        <translation>关于本软件及其组成部分</translation>
    </message>
    <message>
        <source>Restore the defaults of all entries</source>
        <translation>恢复所有条目的默认值</translation>
    </message>
    <message>
        <source>Leave the preferences</source>
        <translation>离开首选项</translation>
    </message>
    <message>
        <source>Kept for you on this computer. Nothing here changes how the robot moves.</source>
        <translation>为您保存在本机上。此处任何设置都不改变机器人的运动方式。</translation>
    </message>
    <message>
        <source>X-ray pulses</source>
        <translation>X 射线脉冲</translation>
    </message>
    <message>
        <source>Pictures per second while the pedal is down; the dose grows with them. A recorded run keeps its own rate.</source>
        <translation>踩下踏板时每秒的图像数；越多剂量越高。录制的序列保持其自身的帧率。</translation>
    </message>
    <message>
        <source>%1 /s</source>
        <translation>%1 /s</translation>
    </message>
    <message>
        <source>Patient side</source>
        <translation>患者端</translation>
    </message>
    <message>
        <source>How you call the people there; the prompt of a lost link shows it.</source>
        <translation>如何呼叫那里的人员；链路丢失的提示单会显示它。</translation>
    </message>
    <message>
        <source>name and telephone number</source>
        <translation>姓名和电话号码</translation>
    </message>
    <message>
        <source>Edges by</source>
        <translation>边缘增强方法</translation>
    </message>
    <message>
        <source>The unsharp mask raises what is as wide as a wire, multi-scale raises weak detail of every size and takes more of this computer. Neither raises noise.</source>
        <translation>反锐化掩模增强导丝粗细的细节；多尺度增强各种大小的微弱细节，占用更多计算资源。两者都不放大噪声。</translation>
    </message>
    <message>
        <source>the last picture</source>
        <translation>最后一帧</translation>
    </message>
    <message>
        <source>mean of %1</source>
        <translation>%1 帧平均</translation>
    </message>
    <message>
        <source>Last image hold</source>
        <translation>末帧保持</translation>
    </message>
    <message>
        <source>What is held when a run ends. A mean of its last pictures has less noise, and what moved is blurred in it. It says how many went in; those of another exposure or place do not.</source>
        <translation>序列结束时保持的图像。最后几帧的平均噪声较低，但运动部分会模糊。图像上注明实际参与平均的帧数；曝光条件或位置不同的帧不参与。</translation>
    </message>
    <message>
        <source>%1 cm</source>
        <translation>%1 cm</translation>
    </message>
    <message>
        <source>Object&apos;s height</source>
        <translation>物体高度</translation>
    </message>
    <message>
        <source>How far above the table what is measured lies, about half of what the patient is thick. Lengths in a plane above the table, Plane or O while measuring, begin with it.</source>
        <translation>被测物体在床面以上的高度，约为患者厚度的一半。床面上方平面内的长度（测量时按“平面”或 O）以此开始。</translation>
    </message>
    <message>
        <source>Table top</source>
        <translation>床面</translation>
    </message>
    <message>
        <source>In mm below the isocentre at the reported table height 0. Without it: no such plane.</source>
        <translation>报告的床高为 0 时床面在等中心以下的 mm 数。未设置则无此平面。</translation>
    </message>
    <message>
        <source>not set up</source>
        <translation>未设置</translation>
    </message>
    <message>
        <source>Table top: &apos;%1&apos; is no whole number of millimetres up to %2.</source>
        <translation>床面：“%1”不是不超过 %2 的整数毫米值。</translation>
    </message>
</context>
<context>
    <name>console::ProgramFacts</name>
    <message>
        <source>System</source>
        <translation>系统</translation>
    </message>
    <message>
        <source>no topology is loaded</source>
        <translation>未加载拓扑</translation>
    </message>
    <message>
        <source>, version %1</source>
        <translation>，版本 %1</translation>
    </message>
    <message>
        <source>%1%2, %3 devices, %4 links of this console</source>
        <translation>%1%2，%3 台设备，本控制台 %4 条链路</translation>
    </message>
    <message>
        <source>Topology hash</source>
        <translation>拓扑哈希</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>sessions are encrypted</source>
        <translation>会话已加密</translation>
    </message>
    <message>
        <source>SESSIONS ARE NOT ENCRYPTED</source>
        <translation>会话未加密</translation>
    </message>
    <message>
        <source>%1 %2 · %3</source>
        <translation>%1 %2 · %3</translation>
    </message>
    <message>
        <source>%1 (in use): %2</source>
        <translation>%1（使用中）：%2</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>Masters</source>
        <translation>主手设备</translation>
    </message>
    <message>
        <source>not known yet</source>
        <translation>尚不清楚</translation>
    </message>
    <message>
        <source>Alarm sound</source>
        <translation>报警声</translation>
    </message>
    <message>
        <source>DOES NOT WORK: see the alarm band</source>
        <translation>不工作：见报警栏</translation>
    </message>
    <message>
        <source>the last self-test was not confirmed</source>
        <translation>上次自检未经证实</translation>
    </message>
    <message>
        <source>seen and heard in this run; F8 tests again before each arming</source>
        <translation>本次运行中已看到并听到；每次解锁前按 F8 再次自检</translation>
    </message>
    <message>
        <source>not known: nobody has tested it in this run (F8)</source>
        <translation>未知：本次运行中无人做过自检 (F8)</translation>
    </message>
    <message>
        <source>Research software. Not a medical device: it has no approval for use on patients anywhere.</source>
        <translation>研究用软件。非医疗器械：在任何地方均未获准用于患者。</translation>
    </message>
    <message>
        <source>liena-console --help</source>
        <translation>liena-console --help</translation>
    </message>
    <message>
        <source>Version</source>
        <translation>版本</translation>
    </message>
    <message>
        <source>Operator</source>
        <translation>操作者</translation>
    </message>
    <message>
        <source>nobody is named (--operator NAME)</source>
        <translation>未指定 (--operator NAME)</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>帮助</translation>
    </message>
</context>
<context>
    <name>console::Prompt</name>
    <message>
        <source>%1st</source>
        <translation>第 %1</translation>
    </message>
    <message>
        <source>%1nd</source>
        <translation>第 %1</translation>
    </message>
    <message>
        <source>%1rd</source>
        <translation>第 %1</translation>
    </message>
    <message>
        <source>%1th</source>
        <translation>第 %1</translation>
    </message>
    <message>
        <source>%1 link lost</source>
        <translation>%1 链路丢失</translation>
    </message>
    <message>
        <source>Link between %1 and %2 lost</source>
        <translation>%1 与 %2 之间的链路丢失</translation>
    </message>
    <message>
        <source>this console is not part of that link; the devices reported it</source>
        <translation>本控制台不在该链路上；由设备报告</translation>
    </message>
    <message>
        <source>to %1: unknown · from %1: unknown</source>
        <translation>去往 %1：未知 · 来自 %1：未知</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>未知</translation>
    </message>
    <message>
        <source>broken</source>
        <translation>已断开</translation>
    </message>
    <message>
        <source>silent</source>
        <translation>无数据</translation>
    </message>
    <message>
        <source>to %1: %2 · from %1: %3</source>
        <translation>去往 %1：%2 · 来自 %1：%3</translation>
    </message>
    <message>
        <source>No robot in this system</source>
        <translation>本系统中没有机器人</translation>
    </message>
    <message>
        <source>NOT CONFIRMED that %1 holds. Its own guard should hold it. Ask the patient side now.</source>
        <translation>未经证实：%1 是否保持。其自身的保护应使其保持。请立即询问患者端。</translation>
    </message>
    <message>
        <source>%1 holds: CONFIRMED %2 ms after the stop</source>
        <translation>%1 保持：已证实，停止后 %2 ms</translation>
    </message>
    <message>
        <source>%1 holds: CONFIRMED, already before the loss was noticed</source>
        <translation>%1 保持：已证实，发现丢失之前即已保持</translation>
    </message>
    <message>
        <source>%1 holds: CONFIRMED</source>
        <translation>%1 保持：已证实</translation>
    </message>
    <message>
        <source>Picture: live</source>
        <translation>图像：实时</translation>
    </message>
    <message>
        <source>Picture: last image hold, of %1</source>
        <translation>图像：末帧保持，%1</translation>
    </message>
    <message>
        <source>Picture: frozen since %1</source>
        <translation>图像：自 %1 起已冻结</translation>
    </message>
    <message>
        <source>Picture: none</source>
        <translation>图像：无</translation>
    </message>
    <message>
        <source>Picture: new ones come, age unknown</source>
        <translation>图像：仍有新图像到达，时龄未知</translation>
    </message>
    <message>
        <source>%1 (a recording)</source>
        <translation>%1（录制）</translation>
    </message>
    <message>
        <source>Picture: a recording, for a rehearsal</source>
        <translation>图像：录制，用于演练</translation>
    </message>
    <message>
        <source>Picture: a recording, nothing to move by</source>
        <translation>图像：录制，不得据以运动</translation>
    </message>
    <message>
        <source>Tip position: live</source>
        <translation>头端位置：实时</translation>
    </message>
    <message>
        <source>Tip position: last known</source>
        <translation>头端位置：最后已知</translation>
    </message>
    <message>
        <source>Tip position: unknown</source>
        <translation>头端位置：未知</translation>
    </message>
    <message>
        <source>%1 saw: %2</source>
        <translation>%1 观察到：%2</translation>
    </message>
    <message>
        <source>Heartbeats in the second before the loss: %1 of %2</source>
        <translation>丢失前一秒的心跳：%2 次中收到 %1 次</translation>
    </message>
    <message>
        <source>Last round trip: %1 ms</source>
        <translation>最后一次往返：%1 ms</translation>
    </message>
    <message>
        <source>Last round trip: unknown</source>
        <translation>最后一次往返：未知</translation>
    </message>
    <message>
        <source>Silent for %1 ms before it was given up</source>
        <translation>判定丢失前无数据 %1 ms</translation>
    </message>
    <message>
        <source>Our connection to it %1, its connection to us %2</source>
        <translation>本端到对方的连接%1，对方到本端的连接%2</translation>
    </message>
    <message>
        <source>held</source>
        <translation>未断</translation>
    </message>
    <message>
        <source>broke</source>
        <translation>已断</translation>
    </message>
    <message>
        <source>Check: %1</source>
        <translation>检查：%1</translation>
    </message>
    <message>
        <source>Other links of this console: %1</source>
        <translation>本控制台的其他链路：%1</translation>
    </message>
    <message>
        <source>Re-open tried %1 times</source>
        <translation>已尝试重新打开 %1 次</translation>
    </message>
    <message>
        <source>The device&apos;s computer does not answer; others there do</source>
        <translation>该设备的计算机无应答；同院区其他计算机有应答</translation>
    </message>
    <message>
        <source>Power and network cable of that device</source>
        <translation>检查该设备的电源和网线</translation>
    </message>
    <message>
        <source>The device&apos;s computer does not answer; others there do not either</source>
        <translation>该设备的计算机无应答；同院区其他计算机也无应答</translation>
    </message>
    <message>
        <source>The site&apos;s network line</source>
        <translation>检查该院区的网络线路</translation>
    </message>
    <message>
        <source>The device&apos;s computer does not answer</source>
        <translation>该设备的计算机无应答</translation>
    </message>
    <message>
        <source>Power and network cable of that device, or the site&apos;s line</source>
        <translation>检查该设备的电源和网线，或该院区的线路</translation>
    </message>
    <message>
        <source>Not known yet: run the checks</source>
        <translation>尚不清楚：请运行检查</translation>
    </message>
    <message>
        <source>Run checks</source>
        <translation>运行检查</translation>
    </message>
    <message>
        <source>This console has no network on that port</source>
        <translation>本控制台该网口没有网络</translation>
    </message>
    <message>
        <source>Plug, cable and switch at this side</source>
        <translation>检查本端的插头、网线和交换机</translation>
    </message>
    <message>
        <source>Network up, no way to the hospital</source>
        <translation>网络正常，但无法到达医院</translation>
    </message>
    <message>
        <source>Gateway and VPN</source>
        <translation>检查网关和 VPN</translation>
    </message>
    <message>
        <source>The computer answers, its program is not running</source>
        <translation>计算机有应答，但其程序没有运行</translation>
    </message>
    <message>
        <source>Restart the program at the patient side</source>
        <translation>请在患者端重新启动该程序</translation>
    </message>
    <message>
        <source>The device answered but its identity was refused</source>
        <translation>设备有应答，但其身份被拒绝</translation>
    </message>
    <message>
        <source>Do not bypass this: call service</source>
        <translation>不要绕过：请联系技术服务</translation>
    </message>
    <message>
        <source>The device&apos;s program hangs or is overloaded</source>
        <translation>该设备的程序停止响应或过载</translation>
    </message>
    <message>
        <source>Wait 2 s, run the checks, then restart its program</source>
        <translation>等待 2 s，运行检查，然后重新启动其程序</translation>
    </message>
    <message>
        <source>The device answers again</source>
        <translation>该设备重新应答</translation>
    </message>
    <message>
        <source>Re-open the channel</source>
        <translation>请重新打开通道</translation>
    </message>
    <message>
        <source>heartbeats stopped</source>
        <translation>心跳停止</translation>
    </message>
    <message>
        <source>the connection broke</source>
        <translation>连接断开</translation>
    </message>
    <message>
        <source>the device restarted</source>
        <translation>设备已重新启动</translation>
    </message>
    <message>
        <source>the device broke the protocol</source>
        <translation>设备违反协议</translation>
    </message>
    <message>
        <source>this console stood still</source>
        <translation>本控制台曾停顿</translation>
    </message>
    <message>
        <source>All links were lost at once: this console&apos;s side or the line, not a device</source>
        <translation>所有链路同时丢失：问题在本控制台一侧或线路，而非某台设备</translation>
    </message>
    <message>
        <source>Network port and VPN of this console</source>
        <translation>检查本控制台的网口和 VPN</translation>
    </message>
    <message>
        <source>Only the pictures are lost: their way, or the X-ray sender</source>
        <translation>只有图像丢失：问题在其通路或 X 射线发送端</translation>
    </message>
    <message>
        <source>Re-open the picture link alone; motion stays inhibited</source>
        <translation>请只重新打开图像链路；运动仍被禁止</translation>
    </message>
    <message>
        <source>for %1, since %2</source>
        <translation>已 %1，自 %2 起</translation>
    </message>
    <message>
        <source>%1 time in 2 min</source>
        <translation>2 min 内%1 次</translation>
    </message>
    <message>
        <source>Between those two devices; this console&apos;s links are not concerned</source>
        <translation>问题在那两台设备之间；不涉及本控制台的链路</translation>
    </message>
    <message>
        <source>Between those two devices</source>
        <translation>问题在那两台设备之间</translation>
    </message>
    <message>
        <source>Not only between those two: this console&apos;s link to %1 is lost, too; its own prompt says more</source>
        <translation>问题不只在那两台设备之间：本控制台到 %1 的链路也已丢失；其自己的提示单会给出更多说明</translation>
    </message>
    <message>
        <source>Not only between those two: this console&apos;s links to both are lost, too; their own prompts say more</source>
        <translation>问题不只在那两台设备之间：本控制台到两者的链路也都已丢失；各自的提示单会给出更多说明</translation>
    </message>
    <message>
        <source>Re-open it at one of them</source>
        <translation>请在其中一台上重新打开</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
    <message>
        <source>%1 link interrupted</source>
        <translation>%1 链路已中断</translation>
    </message>
    <message>
        <source>%1 link was interrupted</source>
        <translation>%1 链路曾中断</translation>
    </message>
    <message>
        <source>to %1: open · from %1: open</source>
        <translation>去往 %1：已打开 · 来自 %1：已打开</translation>
    </message>
    <message>
        <source>for %1 ms, at %2</source>
        <translation>持续 %1 ms，于 %2</translation>
    </message>
    <message>
        <source>Motion needs a new ARM.</source>
        <translation>运动须重新解锁。</translation>
    </message>
    <message>
        <source>What motion waits for stands in the motion bar.</source>
        <translation>运动所等待的条件列在运动栏中。</translation>
    </message>
    <message>
        <source>It healed by itself. If it comes again, run a line check.</source>
        <translation>已自行恢复。若再次出现，请做线路检查。</translation>
    </message>
    <message>
        <source>Not confirmed yet that %1 holds. Its own guard should stop it.</source>
        <translation>尚未证实：%1 是否保持。其自身的保护应使其停止。</translation>
    </message>
    <message>
        <source>Not known yet. LiENa connects again by itself; if it cannot, the system stands by and this prompt says more.</source>
        <translation>尚不清楚。LiENa 正自行重新连接；若不成功，系统将待机，本提示单会给出更多说明。</translation>
    </message>
    <message>
        <source>How to call the patient side is not set up: preferences (Ctrl+,)</source>
        <translation>患者端的呼叫方式未设置：首选项 (Ctrl+,)</translation>
    </message>
    <message>
        <source>Call the patient side: %1</source>
        <translation>呼叫患者端：%1</translation>
    </message>
    <message>
        <source>holds, %1 ms after the loss</source>
        <translation>保持，丢失后 %1 ms</translation>
    </message>
    <message>
        <source>holds, already before the loss was noticed</source>
        <translation>保持，发现丢失之前即已保持</translation>
    </message>
    <message>
        <source>holds</source>
        <translation>保持</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>NOT CONFIRMED</source>
        <translation>未经证实</translation>
    </message>
    <message>
        <source>Began %1, incident %2</source>
        <translation>开始于 %1，事件 %2</translation>
    </message>
    <message>
        <source>Silence %1 s</source>
        <translation>静音 %1 s</translation>
    </message>
    <message>
        <source>%1 holds: CONFIRMED by its own report</source>
        <translation>%1 保持：已由其自身报告证实</translation>
    </message>
    <message>
        <source>same computer</source>
        <translation>同一台计算机</translation>
    </message>
    <message>
        <source>not open</source>
        <translation>未打开</translation>
    </message>
    <message>
        <source>%1 (%2) %3</source>
        <translation>%1（%2）%3</translation>
    </message>
    <message>
        <source>, </source>
        <translation>、</translation>
    </message>
    <message>
        <source>it is another device</source>
        <translation>它是另一台设备</translation>
    </message>
    <message>
        <source>a certificate has expired</source>
        <translation>证书已过期</translation>
    </message>
    <message>
        <source>a certificate is not valid yet</source>
        <translation>证书尚未生效</translation>
    </message>
    <message>
        <source>a certificate was revoked</source>
        <translation>证书已被吊销</translation>
    </message>
    <message>
        <source>of an authority that is not known there</source>
        <translation>签发机构不被认可</translation>
    </message>
    <message>
        <source>The device answered but its identity was refused: %1</source>
        <translation>设备有应答，但其身份被拒绝：%1</translation>
    </message>
    <message>
        <source>This console has no network on its port with the address %1</source>
        <translation>本控制台地址为 %1 的网口没有网络</translation>
    </message>
    <message>
        <source>open</source>
        <translation>已打开</translation>
    </message>
    <message>
        <source>%1: device %2 at %3</source>
        <translation>%1：设备 %2，地址 %3</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
    <message>
        <source>%1 said last: %2</source>
        <translation>%1 最后报告：%2</translation>
    </message>
    <message>
        <source>Topology %1, hash %2</source>
        <translation>拓扑 %1，哈希 %2</translation>
    </message>
    <message>
        <source>%1, same interface</source>
        <translation>%1，同一网络接口</translation>
    </message>
    <message>
        <source>%1, by %2</source>
        <translation>%1，经 %2</translation>
    </message>
</context>
<context>
    <name>console::RecordedMaster</name>
    <message>
        <source>%1 values instead of 5; write time,x,y,z,buttons</source>
        <translation>有 %1 个值，应为 5 个；请写 time,x,y,z,buttons</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a number</source>
        <translation>“%1”不是数</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a set of buttons; write a whole number</source>
        <translation>“%1”不是按钮组合；请写整数</translation>
    </message>
    <message>
        <source>the first line must be time,x,y,z,buttons</source>
        <translation>第一行必须是 time,x,y,z,buttons</translation>
    </message>
    <message>
        <source>time must start at 0 and rise from line to line</source>
        <translation>time 必须从 0 开始并逐行增大</translation>
    </message>
    <message>
        <source>at least two samples are needed</source>
        <translation>至少需要两个样本</translation>
    </message>
    <message>
        <source>%1: cannot be read: %2</source>
        <translation>%1：无法读取：%2</translation>
    </message>
    <message>
        <source>larger than 64 MiB</source>
        <translation>大于 64 MiB</translation>
    </message>
    <message>
        <source>moves as it was recorded while D is held</source>
        <translation>按住 D 时按录制动作运动</translation>
    </message>
</context>
<context>
    <name>console::ReferenceImageView</name>
    <message>
        <source>Reference X-ray image</source>
        <translation>参考 X 射线图像</translation>
    </message>
    <message>
        <source>Picture of %1</source>
        <translation>图像时刻 %1</translation>
    </message>
    <message>
        <source>No reference picture yet. The last image of a run is held here, and the last minute can be reviewed.</source>
        <translation>尚无参考图像。每个序列的末帧保持在此，最近一分钟可以回放。</translation>
    </message>
    <message>
        <source>%1; the picture was taken at %2. It is not the live picture.</source>
        <translation>%1；图像拍摄于 %2。这不是实时图像。</translation>
    </message>
    <message>
        <source>%1 %2.</source>
        <translation>%1 %2。</translation>
    </message>
    <message>
        <source>No reference picture yet.</source>
        <translation>尚无参考图像。</translation>
    </message>
</context>
<context>
    <name>console::ReviewControls</name>
    <message>
        <source>Reference picture controls</source>
        <translation>参考图像控制</translation>
    </message>
    <message>
        <source>Hold</source>
        <translation>末帧</translation>
    </message>
    <message>
        <source>Last image hold</source>
        <translation>末帧保持</translation>
    </message>
    <message>
        <source>The last picture of the run</source>
        <translation>本序列的最后一幅图像</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>回放</translation>
    </message>
    <message>
        <source>The last minute</source>
        <translation>最近一分钟</translation>
    </message>
    <message>
        <source>Oldest picture</source>
        <translation>最早的图像</translation>
    </message>
    <message>
        <source>To the oldest picture</source>
        <translation>到最早的图像</translation>
    </message>
    <message>
        <source>One picture back</source>
        <translation>后退一幅</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>播放</translation>
    </message>
    <message>
        <source>As a film, in the time in which it was taken</source>
        <translation>按拍摄时的速度连续播放</translation>
    </message>
    <message>
        <source>One picture on</source>
        <translation>前进一幅</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Save reference picture</source>
        <translation>保存参考图像</translation>
    </message>
    <message>
        <source>As PNG and as DICOM Secondary Capture</source>
        <translation>存为 PNG 和 DICOM Secondary Capture</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>Stop the film</source>
        <translation>停止播放</translation>
    </message>
    <message>
        <source>Roadmap</source>
        <translation>路图</translation>
    </message>
    <message>
        <source>The live picture under the vessels that the last run with contrast filled</source>
        <translation>实时图像，叠加最近一个造影序列中充盈的血管</translation>
    </message>
    <message>
        <source>Strength of the roadmap&apos;s vessels</source>
        <translation>路图血管的浓度</translation>
    </message>
    <message>
        <source>Weaker vessels of the roadmap</source>
        <translation>减弱路图血管</translation>
    </message>
    <message>
        <source>Stronger vessels of the roadmap</source>
        <translation>增强路图血管</translation>
    </message>
</context>
<context>
    <name>console::RoadmapState</name>
    <message>
        <source>ROADMAP REMOVED: %1</source>
        <translation>路图已移除：%1</translation>
    </message>
    <message>
        <source>Vessels of %1, run %2</source>
        <translation>%1 的血管，序列 %2</translation>
    </message>
    <message>
        <source>the C-arm turned</source>
        <translation>C 臂转动了</translation>
    </message>
    <message>
        <source>the distances of the C-arm changed</source>
        <translation>C 臂的距离改变了</translation>
    </message>
    <message>
        <source>the zoom changed</source>
        <translation>缩放改变了</translation>
    </message>
    <message>
        <source>the pictures come from elsewhere</source>
        <translation>图像来自别处</translation>
    </message>
    <message>
        <source>the table moved</source>
        <translation>床移动了</translation>
    </message>
    <message>
        <source>the patient moved</source>
        <translation>患者移动了</translation>
    </message>
</context>
<context>
    <name>console::RobotPanel</name>
    <message>
        <source>Guidewire</source>
        <translation>导丝</translation>
    </message>
    <message>
        <source>Catheter</source>
        <translation>导管</translation>
    </message>
    <message>
        <source>Robot</source>
        <translation>机器人</translation>
    </message>
    <message>
        <source>Tracker ±0.0&#xa0;mm · stale 000&#xa0;ms</source>
        <translation>跟踪器 ±0.0&#xa0;mm · 过时 000&#xa0;ms</translation>
    </message>
    <message>
        <source>no report received</source>
        <translation>未收到报告</translation>
    </message>
    <message>
        <source>last known: %1</source>
        <translation>最后已知：%1</translation>
    </message>
    <message>
        <source>, stands still</source>
        <translation>，静止</translation>
    </message>
    <message>
        <source>Drives —</source>
        <translation>驱动器 —</translation>
    </message>
    <message>
        <source>Tracker —</source>
        <translation>跟踪器 —</translation>
    </message>
    <message>
        <source>Tracker ±%1</source>
        <translation>跟踪器 ±%1</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>Tracker does not see the tip</source>
        <translation>跟踪器看不到头端</translation>
    </message>
    <message>
        <source>Robotic arm: %1</source>
        <translation>机械臂：%1</translation>
    </message>
    <message>
        <source>Drives off</source>
        <translation>驱动器未启用</translation>
    </message>
    <message>
        <source>Drives enabled</source>
        <translation>驱动器已启用</translation>
    </message>
    <message>
        <source>%1 of %2 drives enabled</source>
        <translation>%2 个驱动器中 %1 个已启用</translation>
    </message>
</context>
<context>
    <name>console::RollCall</name>
    <message>
        <source>not confirmed</source>
        <translation>未经证实</translation>
    </message>
    <message>
        <source>holds already</source>
        <translation>此前已保持</translation>
    </message>
    <message>
        <source>holds, after %1</source>
        <translation>保持，%1 后</translation>
    </message>
    <message>
        <source>ms</source>
        <translation>ms</translation>
    </message>
    <message>
        <source>holds</source>
        <translation>保持</translation>
    </message>
    <message>
        <source>Roll-call: which devices hold</source>
        <translation>点名：哪些设备保持</translation>
    </message>
</context>
<context>
    <name>console::Scene</name>
    <message>
        <source>OpenGL&apos;s functions could not be loaded. Check the graphics driver.</source>
        <translation>无法加载 OpenGL 函数。请检查显卡驱动。</translation>
    </message>
</context>
<context>
    <name>console::SceneRenderer</name>
    <message>
        <source>OpenGL drew no picture. Check the graphics driver.</source>
        <translation>OpenGL 未绘出图像。请检查显卡驱动。</translation>
    </message>
</context>
<context>
    <name>console::SceneView</name>
    <message>
        <source>Three-dimensional scene</source>
        <translation>三维场景</translation>
    </message>
    <message>
        <source>? LAST KNOWN</source>
        <translation>? 最后已知</translation>
    </message>
    <message>
        <source>3-D SCENE</source>
        <translation>三维场景</translation>
    </message>
    <message>
        <source>tip not tracked</source>
        <translation>头端未跟踪</translation>
    </message>
    <message>
        <source>tip position stale</source>
        <translation>头端位置过时</translation>
    </message>
    <message>
        <source>no picture</source>
        <translation>无图像</translation>
    </message>
    <message>
        <source>picture: %1</source>
        <translation>图像：%1</translation>
    </message>
    <message>
        <source>picture&apos;s place unknown</source>
        <translation>图像位置未知</translation>
    </message>
    <message>
        <source>3-D not available: %1</source>
        <translation>三维不可用：%1</translation>
    </message>
    <message>
        <source>No vessel tree is loaded.</source>
        <translation>未加载血管树。</translation>
    </message>
    <message>
        <source>Vessels, tracked tip and C-arm. 4 6 8 2 turn, plus and minus zoom, Home shows the vessels, End the C-arm.</source>
        <translation>血管、所跟踪的头端和 C 臂。4 6 8 2 旋转，加减号缩放，Home 显示血管，End 显示 C 臂。</translation>
    </message>
    <message>
        <source>BEFORE</source>
        <translation>之前</translation>
    </message>
    <message>
        <source>NOW</source>
        <translation>现在</translation>
    </message>
</context>
<context>
    <name>console::ScreenDesk</name>
    <message>
        <source>layout saved: %1</source>
        <translation>布局已保存：%1</translation>
    </message>
    <message>
        <source>layout deleted</source>
        <translation>布局已删除</translation>
    </message>
    <message>
        <source>There is no layout %1; F7 saves one.</source>
        <translation>没有布局 %1；按 F7 保存一个。</translation>
    </message>
    <message>
        <source>Screens stay as they are while the permit is %1.</source>
        <translation>许可为 %1 时屏幕保持原样。</translation>
    </message>
    <message>
        <source>A screen that this layout asks for is not there: what was on it is in the cockpit.</source>
        <translation>该布局所需的屏幕不在：其内容在驾驶舱中。</translation>
    </message>
    <message>
        <source>layout: %1</source>
        <translation>布局：%1</translation>
    </message>
    <message>
        <source>The screen %1 is gone; the cockpit is on %2. The hand has no keys until you click into the cockpit or press F1.</source>
        <translation>屏幕 %1 已移除；驾驶舱在 %2 上。在您点击驾驶舱或按 F1 之前，主手操作键无效。</translation>
    </message>
    <message>
        <source>The screen %1 is gone; what was on it is in the cockpit.</source>
        <translation>屏幕 %1 已移除；其内容在驾驶舱中。</translation>
    </message>
    <message>
        <source>Overview</source>
        <translation>总览</translation>
    </message>
    <message>
        <source>Event log, oldest first</source>
        <translation>运行日志，最早的在前</translation>
    </message>
    <message>
        <source>Reference picture</source>
        <translation>参考图像</translation>
    </message>
    <message>
        <source>Screens and layouts stay as they are: the permit is %1. Pictures can change places.</source>
        <translation>屏幕和布局保持原样：许可为 %1。图像可以互换位置。</translation>
    </message>
</context>
<context>
    <name>console::ScreenPlan</name>
    <message>
        <source>live large</source>
        <translation>实时图像为大图</translation>
    </message>
    <message>
        <source>reference beside it</source>
        <translation>参考图像在旁</translation>
    </message>
    <message>
        <source>scene beside it</source>
        <translation>三维场景在旁</translation>
    </message>
</context>
<context>
    <name>console::ScreensView</name>
    <message>
        <source>To the cockpit  F1</source>
        <translation>到驾驶舱  F1</translation>
    </message>
    <message>
        <source>Save layout</source>
        <translation>保存布局</translation>
    </message>
    <message>
        <source>Screens and layouts</source>
        <translation>屏幕和布局</translation>
    </message>
    <message>
        <source>Leave screens and layouts</source>
        <translation>离开屏幕和布局</translation>
    </message>
    <message>
        <source>Screens, pictures and layouts</source>
        <translation>屏幕、图像和布局</translation>
    </message>
    <message>
        <source>Name for the present layout</source>
        <translation>当前布局的名称</translation>
    </message>
    <message>
        <source>name for the present layout</source>
        <translation>当前布局的名称</translation>
    </message>
    <message>
        <source>Save the present layout under this name</source>
        <translation>以此名称保存当前布局</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>图像</translation>
    </message>
    <message>
        <source>F10 changes the reference and the live picture over, F11 the scene. The live picture keeps its unbroken frame and is never smaller than another.</source>
        <translation>F10 互换参考图像与实时图像，F11 互换三维场景。实时图像保留其实线边框，且绝不小于其他图像。</translation>
    </message>
    <message>
        <source>none</source>
        <translation>无</translation>
    </message>
    <message>
        <source>Second screen</source>
        <translation>第二屏幕</translation>
    </message>
    <message>
        <source>Topology, conditions for motion, plots, trends and log. It moves nothing; the hand has no keys in it.</source>
        <translation>拓扑、运动条件、曲线、趋势和日志。它不引起任何运动；主手操作键在此屏幕上无效。</translation>
    </message>
    <message>
        <source>no further screen is there</source>
        <translation>没有其他屏幕</translation>
    </message>
    <message>
        <source>Third screen</source>
        <translation>第三屏幕</translation>
    </message>
    <message>
        <source>The reference picture, at most as large as the live one.</source>
        <translation>参考图像，至多与实时图像一样大。</translation>
    </message>
    <message>
        <source>No layout is saved yet</source>
        <translation>尚未保存布局</translation>
    </message>
    <message>
        <source>Layouts</source>
        <translation>布局</translation>
    </message>
    <message>
        <source>Ctrl+%1  %2</source>
        <translation>Ctrl+%1  %2</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>恢复</translation>
    </message>
    <message>
        <source>Restore the layout %1</source>
        <translation>恢复布局 %1</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>删除</translation>
    </message>
    <message>
        <source>Delete the layout %1</source>
        <translation>删除布局 %1</translation>
    </message>
</context>
<context>
    <name>console::SdlPads</name>
    <message>
        <source>game pads cannot be heard: %1</source>
        <translation>无法接收游戏手柄：%1</translation>
    </message>
    <message>
        <source> (Bluetooth)</source>
        <translation>（蓝牙）</translation>
    </message>
</context>
<context>
    <name>console::SeatListener</name>
    <message>
        <source>there is no system bus</source>
        <translation>没有系统总线</translation>
    </message>
    <message>
        <source>logind does not tell whether somebody sees this screen: %1</source>
        <translation>logind 未告知是否有人能看到本屏幕：%1</translation>
    </message>
    <message>
        <source>its bus has ended</source>
        <translation>其总线已终止</translation>
    </message>
    <message>
        <source>Screen is locked</source>
        <translation>屏幕已锁定</translation>
    </message>
    <message>
        <source>Another session is on this screen</source>
        <translation>本屏幕正显示另一登录会话</translation>
    </message>
    <message>
        <source>Screen saver is on</source>
        <translation>屏幕保护程序已启动</translation>
    </message>
    <message>
        <source>Screen was hidden, no word since: restart the console</source>
        <translation>屏幕曾不可见，此后再无消息：请重新启动控制台</translation>
    </message>
</context>
<context>
    <name>console::SelfTestBlock</name>
    <message>
        <source>Alarm self-test (F8)</source>
        <translation>报警自检 (F8)</translation>
    </message>
    <message>
        <source>Begin the alarm self-test: three colours and three sounds</source>
        <translation>开始报警自检：三种颜色和三种声音</translation>
    </message>
    <message>
        <source>All three alarm colours were seen, and the sounds heard</source>
        <translation>三种报警颜色均已看到，声音均已听到</translation>
    </message>
    <message>
        <source>Test not right</source>
        <translation>自检不正常</translation>
    </message>
    <message>
        <source>An alarm colour or a sound was missing</source>
        <translation>缺少某种报警颜色或声音</translation>
    </message>
    <message>
        <source>Test seen and heard</source>
        <translation>自检已看到并听到</translation>
    </message>
    <message>
        <source>Test seen; no sound here</source>
        <translation>自检已看到；本端无声音</translation>
    </message>
</context>
<context>
    <name>console::SessionIntake</name>
    <message>
        <source>given up by the operator</source>
        <translation>操作者已放弃</translation>
    </message>
    <message>
        <source>an unknown device</source>
        <translation>未知设备</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1（%2）</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>%1: opened in %2 ms</source>
        <translation>%1：已打开，用时 %2 ms</translation>
    </message>
    <message>
        <source>%1: not opened: %2</source>
        <translation>%1：未打开：%2</translation>
    </message>
    <message>
        <source>%1: lost, %2</source>
        <translation>%1：丢失，%2</translation>
    </message>
    <message>
        <source>%1: checked: %2</source>
        <translation>%1：已检查：%2</translation>
    </message>
    <message>
        <source>%1 saw: %2</source>
        <translation>%1 观察到：%2</translation>
    </message>
    <message>
        <source>incident given up: %1</source>
        <translation>事件已放弃：%1</translation>
    </message>
    <message>
        <source>incident ended</source>
        <translation>事件已结束</translation>
    </message>
    <message>
        <source>%1 – %2: %3</source>
        <translation>%1 – %2：%3</translation>
    </message>
    <message>
        <source>%1 confirms that it holds</source>
        <translation>%1 证实其保持</translation>
    </message>
    <message>
        <source>%1 no longer holds</source>
        <translation>%1 不再保持</translation>
    </message>
    <message>
        <source>the system stands by</source>
        <translation>系统待机</translation>
    </message>
    <message>
        <source>stand-by ended; motion needs a new ARM</source>
        <translation>待机已结束；运动须重新解锁</translation>
    </message>
    <message>
        <source>%1: closed in order. %2</source>
        <translation>%1：已正常关闭。%2</translation>
    </message>
    <message>
        <source>%1: interrupted for %2 ms; motion needs a new ARM</source>
        <translation>%1：中断 %2 ms；运动须重新解锁</translation>
    </message>
    <message>
        <source>%1: %2 is overdue</source>
        <translation>%1：%2逾时未到</translation>
    </message>
    <message>
        <source>%1: %2 message(s) %3 dropped: %4</source>
        <translation>%1：舍弃 %2 条报文 %3：%4</translation>
    </message>
    <message>
        <source>%1: %2 was not sent: %3</source>
        <translation>%1：%2 未发送：%3</translation>
    </message>
    <message>
        <source>a connection of %1 was not let in: %2</source>
        <translation>%1 的连接未被接入：%2</translation>
    </message>
    <message>
        <source>this console stood still for %1 ms</source>
        <translation>本控制台停顿 %1 ms</translation>
    </message>
    <message>
        <source>no audit file is written, so no new session opens: %1</source>
        <translation>审计文件未能写入，因此不打开新会话：%1</translation>
    </message>
    <message>
        <source>the audit file is written again</source>
        <translation>审计文件已恢复写入</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 到 %2</translation>
    </message>
    <message>
        <source>%1: another way now, from %2; before from %3</source>
        <translation>%1：现改走另一路径，从 %2；此前从 %3</translation>
    </message>
</context>
<context>
    <name>console::SheetDeck</name>
    <message>
        <source>Diagnosis</source>
        <translation>诊断</translation>
    </message>
</context>
<context>
    <name>console::SideWindow</name>
    <message>
        <source>LiENa %1 — research system, not a medical device</source>
        <translation>LiENa %1 — 研究用系统，非医疗器械</translation>
    </message>
    <message>
        <source>The live picture, alarms and motion are in the cockpit (F1). Esc is the emergency stop here, too.</source>
        <translation>实时图像、报警和运动都在驾驶舱 (F1)。此处 Esc 同样是急停。</translation>
    </message>
    <message>
        <source>RESEARCH SYSTEM
NOT A MEDICAL DEVICE</source>
        <translation>研究用系统
非医疗器械</translation>
    </message>
</context>
<context>
    <name>console::SpaceMouseMaster</name>
    <message>
        <source>left button dead-man · push, twist guidewire · lift, tilt catheter · right button clutch · F X-ray · R arm · G inject · Page Up/Down scale</source>
        <translation>左键 握持开关 · 推、拧 导丝 · 提、倾 导管 · 右键 离合 · F X 射线 · R 解锁 · G 注射 · Page Up/Down 运动比例</translation>
    </message>
</context>
<context>
    <name>console::SpnavLine</name>
    <message>
        <source>spacenavd is too old: it does not say when the mouse is unplugged; install 1.0 or newer</source>
        <translation>spacenavd 版本过旧：它不报告鼠标被拔出；请安装 1.0 或更新版本</translation>
    </message>
</context>
<context>
    <name>console::StaleMark</name>
    <message>
        <source>age %1</source>
        <translation>时龄 %1</translation>
    </message>
    <message>
        <source>stale %1</source>
        <translation>过时 %1</translation>
    </message>
    <message>
        <source>never received</source>
        <translation>从未收到</translation>
    </message>
</context>
<context>
    <name>console::StartView</name>
    <message>
        <source>To the cockpit  F1</source>
        <translation>到驾驶舱  F1</translation>
    </message>
    <message>
        <source>About</source>
        <translation>关于</translation>
    </message>
    <message>
        <source>How it stands</source>
        <translation>当前状态</translation>
    </message>
    <message>
        <source>Start page</source>
        <translation>起始页</translation>
    </message>
    <message>
        <source>LiENa: a surgeon&apos;s console for remote vascular intervention</source>
        <translation>LiENa：远程血管介入的医生控制台</translation>
    </message>
    <message>
        <source>Leave the start page</source>
        <translation>离开起始页</translation>
    </message>
    <message>
        <source>About this software and its parts</source>
        <translation>关于本软件及其组成部分</translation>
    </message>
    <message>
        <source>How to begin</source>
        <translation>如何开始</translation>
    </message>
    <message>
        <source>F8</source>
        <translation>F8</translation>
    </message>
    <message>
        <source>Alarm self-test: three colours and three sounds; say whether they were there. Before each arming.</source>
        <translation>报警自检：三种颜色和三种声音；请回答是否都有。每次解锁前进行。</translation>
    </message>
    <message>
        <source>F2</source>
        <translation>F2</translation>
    </message>
    <message>
        <source>Topology, then “Open all”: opens the sessions with the devices. Nothing moves by it.</source>
        <translation>拓扑，然后“全部打开”：打开与各设备的会话。不会引起任何运动。</translation>
    </message>
    <message>
        <source>F</source>
        <translation>F</translation>
    </message>
    <message>
        <source>Held: X-ray pictures. Then look at the list of conditions in the bar below.</source>
        <translation>按住：X 射线图像。然后查看下方栏中的条件列表。</translation>
    </message>
    <message>
        <source>R</source>
        <translation>R</translation>
    </message>
    <message>
        <source>Held for 1.5 s: arms, when every condition is met. Motion lasts only while the dead-man is held.</source>
        <translation>按住 1.5 s：条件全部满足时解锁。只有按住握持开关时才运动。</translation>
    </message>
    <message>
        <source>F12</source>
        <translation>F12</translation>
    </message>
    <message>
        <source>Hold: ends motion, from everywhere on this screen.</source>
        <translation>保持：结束运动，在本屏幕任何位置均可。</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Emergency stop, always, from everywhere on this screen.</source>
        <translation>急停，随时有效，在本屏幕任何位置均可。</translation>
    </message>
</context>
<context>
    <name>console::StatusStrip</name>
    <message>
        <source>STANDBY</source>
        <translation>待命</translation>
    </message>
    <message>
        <source>READY</source>
        <translation>就绪</translation>
    </message>
    <message>
        <source>ARMED</source>
        <translation>已解锁</translation>
    </message>
    <message>
        <source>ENGAGED</source>
        <translation>随动</translation>
    </message>
    <message>
        <source>HOLD</source>
        <translation>保持</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>患者</translation>
    </message>
    <message>
        <source>Procedure</source>
        <translation>手术计时</translation>
    </message>
    <message>
        <source>System</source>
        <translation>系统</translation>
    </message>
    <message>
        <source>Operator</source>
        <translation>操作者</translation>
    </message>
    <message>
        <source>Recorder</source>
        <translation>记录</translation>
    </message>
    <message>
        <source>Local time</source>
        <translation>本地时间</translation>
    </message>
    <message>
        <source>Status strip</source>
        <translation>状态条</translation>
    </message>
    <message>
        <source>RESEARCH SYSTEM
NOT A MEDICAL DEVICE</source>
        <translation>研究用系统
非医疗器械</translation>
    </message>
    <message>
        <source>Research system, not a medical device</source>
        <translation>研究用系统，非医疗器械</translation>
    </message>
    <message>
        <source>None loaded</source>
        <translation>未加载</translation>
    </message>
    <message>
        <source>Not signed in</source>
        <translation>未登录</translation>
    </message>
    <message>
        <source>REHEARSAL, RECORDED PICTURE
NOT A MEDICAL DEVICE</source>
        <translation>演练，录制图像
非医疗器械</translation>
    </message>
    <message>
        <source>Rehearsal with a recorded picture, not a medical device</source>
        <translation>使用录制图像的演练，非医疗器械</translation>
    </message>
    <message>
        <source>Not started</source>
        <translation>未开始</translation>
    </message>
    <message>
        <source>About</source>
        <translation>关于</translation>
    </message>
    <message>
        <source>About this software</source>
        <translation>关于本软件</translation>
    </message>
    <message>
        <source>What this is, its version, and the licences of its parts</source>
        <translation>本软件是什么、其版本及组成部分的许可证</translation>
    </message>
    <message>
        <source>Alarm log</source>
        <translation>报警日志</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>已停止</translation>
    </message>
    <message>
        <source>Not named</source>
        <translation>未指定</translation>
    </message>
    <message>
        <source>ms</source>
        <translation>ms</translation>
    </message>
    <message>
        <source>not compared</source>
        <translation>未比对</translation>
    </message>
</context>
<context>
    <name>console::StopButton</name>
    <message>
        <source>E-STOP</source>
        <translation>急停</translation>
    </message>
    <message>
        <source>Emergency stop</source>
        <translation>急停</translation>
    </message>
    <message>
        <source>STOPPED</source>
        <translation>已急停</translation>
    </message>
    <message>
        <source>The robot reports an emergency stop</source>
        <translation>机器人报告急停</translation>
    </message>
</context>
<context>
    <name>console::SystemLink</name>
    <message>
        <source>%1 cannot be moved from here (%2); compare the message sets</source>
        <translation>无法从本控制台移动%1（%2）；请核对报文集</translation>
    </message>
    <message>
        <source>pictures do not have the fields that this console knows: %1</source>
        <translation>图像缺少本控制台所知的字段：%1</translation>
    </message>
    <message>
        <source>re-open %1</source>
        <translation>重新打开 %1</translation>
    </message>
    <message>
        <source>give an incident up: %1</source>
        <translation>放弃事件：%1</translation>
    </message>
    <message>
        <source>permit request not sent: %1</source>
        <translation>许可请求未发送：%1</translation>
    </message>
    <message>
        <source>EMERGENCY STOP: %1</source>
        <translation>急停：%1</translation>
    </message>
    <message>
        <source>EMERGENCY STOP NOT SENT: %1. Use the stop at the patient side.</source>
        <translation>急停未发出：%1。使用患者端的急停。</translation>
    </message>
    <message>
        <source>emergency stop reset</source>
        <translation>急停已复位</translation>
    </message>
    <message>
        <source>emergency stop not reset: %1</source>
        <translation>急停未复位：%1</translation>
    </message>
    <message>
        <source>Esc key on the console</source>
        <translation>控制台的 Esc 键</translation>
    </message>
    <message>
        <source>Button on the console&apos;s screen</source>
        <translation>控制台屏幕上的按钮</translation>
    </message>
    <message>
        <source>Esc key on the console&apos;s further screen</source>
        <translation>控制台另一屏幕上的 Esc 键</translation>
    </message>
    <message>
        <source>pictures of %1 are not shown: this console works with %2</source>
        <translation>不显示 %1 的图像：本控制台使用 %2</translation>
    </message>
    <message>
        <source>injection %1: %2 mL at %3 mL/s asked for</source>
        <translation>注射 %1：已请求 %2 mL，%3 mL/s</translation>
    </message>
    <message>
        <source>not sent: %1</source>
        <translation>未发送：%1</translation>
    </message>
</context>
<context>
    <name>console::TopologyCanvas</name>
    <message>
        <source>no site given</source>
        <translation>未给出院区</translation>
    </message>
    <message>
        <source>%1 side</source>
        <translation>%1 端</translation>
    </message>
    <message>
        <source>Small topology; choose it to see the whole</source>
        <translation>小拓扑图；选择它以查看全图</translation>
    </message>
    <message>
        <source>Topology</source>
        <translation>拓扑</translation>
    </message>
    <message>
        <source>Link of %1 and %2</source>
        <translation>%1 与 %2 的链路</translation>
    </message>
</context>
<context>
    <name>console::TopologyView</name>
    <message>
        <source>Open all</source>
        <translation>全部打开</translation>
    </message>
    <message>
        <source>this console</source>
        <translation>本控制台</translation>
    </message>
    <message>
        <source>lost,
in stand-by</source>
        <translation>丢失，
待机</translation>
    </message>
    <message>
        <source>state not
known here</source>
        <translation>此处状态
未知</translation>
    </message>
    <message>
        <source>ms</source>
        <translation>ms</translation>
    </message>
    <message>
        <source>%1 · out %2/s · in %3/s</source>
        <translation>%1 · 发 %2/s · 收 %3/s</translation>
    </message>
    <message>
        <source>Topology view</source>
        <translation>拓扑视图</translation>
    </message>
    <message>
        <source>Open all closed links, one after the other</source>
        <translation>依次打开所有已关闭的链路</translation>
    </message>
    <message>
        <source>%1 %2 · hash %3 · %4</source>
        <translation>%1 %2 · 哈希 %3 · %4</translation>
    </message>
    <message>
        <source>encrypted, identities checked</source>
        <translation>已加密，身份已核验</translation>
    </message>
    <message>
        <source>NOT ENCRYPTED, identities not checked</source>
        <translation>未加密，身份未核验</translation>
    </message>
    <message>
        <source>Choose a link with the mouse, or with Tab and Enter.</source>
        <translation>请用鼠标，或用 Tab 和 Enter 选择链路。</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 与 %2</translation>
    </message>
    <message>
        <source>%1: these two talk without this console. Their state is not known here.</source>
        <translation>%1：这两台设备不经本控制台通信。其状态在此未知。</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>%1: %2, message set %3, at %4</source>
        <translation>%1：%2，报文集 %3，位于 %4</translation>
    </message>
</context>
<context>
    <name>console::TrendsPane</name>
    <message>
        <source>Round trip</source>
        <translation>往返</translation>
    </message>
    <message>
        <source>Jitter</source>
        <translation>抖动</translation>
    </message>
    <message>
        <source>Loss</source>
        <translation>丢失率</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>受力</translation>
    </message>
    <message>
        <source>Picture age</source>
        <translation>图像时龄</translation>
    </message>
    <message>
        <source>Trends</source>
        <translation>趋势</translation>
    </message>
    <message>
        <source>60 s</source>
        <translation>60 s</translation>
    </message>
    <message>
        <source>Span of the trends</source>
        <translation>趋势的时间跨度</translation>
    </message>
    <message>
        <source>10 min</source>
        <translation>10 min</translation>
    </message>
</context>
<context>
    <name>console::VesselTree</name>
    <message>
        <source>seven numbers are expected: number, kind, x, y, z, radius, parent</source>
        <translation>应有七个数：编号、类型、x、y、z、半径、父点</translation>
    </message>
    <message>
        <source>a number cannot be read, or is out of range</source>
        <translation>某个数无法读取或超出范围</translation>
    </message>
    <message>
        <source>the point number is used twice</source>
        <translation>点编号重复使用</translation>
    </message>
    <message>
        <source>there are more than 200 000 points</source>
        <translation>点数超过 200 000</translation>
    </message>
    <message>
        <source>the parent must stand before its children</source>
        <translation>父点必须位于其子点之前</translation>
    </message>
    <message>
        <source>%1 cannot be read: %2. Name a vessel tree (SWC) in the settings.</source>
        <translation>无法读取 %1：%2。请在设置中指定血管树 (SWC)。</translation>
    </message>
    <message>
        <source>%1 is larger than 32 MiB and is not read.</source>
        <translation>%1 大于 32 MiB，不予读取。</translation>
    </message>
    <message>
        <source>%1:%2: %3.</source>
        <translation>%1:%2：%3。</translation>
    </message>
    <message>
        <source>%1 holds no vessel point.</source>
        <translation>%1 中没有血管点。</translation>
    </message>
</context>
<context>
    <name>console::WatchdogProcess</name>
    <message>
        <source>%1 was not started: %2</source>
        <translation>%1 未能启动：%2</translation>
    </message>
    <message>
        <source>its watchdog has ended</source>
        <translation>其看门狗已结束</translation>
    </message>
    <message>
        <source>its watchdog does not answer</source>
        <translation>其看门狗无应答</translation>
    </message>
</context>
<context>
    <name>console::Waterfall</name>
    <message>
        <source>Where the picture&apos;s age comes from</source>
        <translation>图像时龄的来源</translation>
    </message>
    <message>
        <source>age at the paint</source>
        <translation>绘制时的时龄</translation>
    </message>
    <message>
        <source>to the screen</source>
        <translation>送至屏幕</translation>
    </message>
    <message>
        <source>%1: median %2, 99th percentile %3</source>
        <translation>%1：中位数 %2，第 99 百分位 %3</translation>
    </message>
    <message>
        <source>ms</source>
        <translation>ms</translation>
    </message>
    <message>
        <source>No picture in the last minute</source>
        <translation>最近一分钟没有图像</translation>
    </message>
    <message>
        <source>000.0 / 0000.0 ms</source>
        <translation>000.0 / 0000.0 ms</translation>
    </message>
    <message>
        <source>%1 / %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>上限 %1</translation>
    </message>
</context>
<context>
    <name>console::Words</name>
    <message>
        <source>closed</source>
        <translation>已关闭</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>正在打开</translation>
    </message>
    <message>
        <source>open</source>
        <translation>已打开</translation>
    </message>
    <message>
        <source>suspect</source>
        <translation>可疑</translation>
    </message>
    <message>
        <source>interrupted</source>
        <translation>已中断</translation>
    </message>
    <message>
        <source>stand-by</source>
        <translation>待机</translation>
    </message>
    <message>
        <source>re-opening</source>
        <translation>正在重新打开</translation>
    </message>
    <message>
        <source>closing</source>
        <translation>正在关闭</translation>
    </message>
    <message>
        <source>LIVE</source>
        <translation>实时</translation>
    </message>
    <message>
        <source>LAST IMAGE HOLD</source>
        <translation>末帧保持</translation>
    </message>
    <message>
        <source>REVIEW</source>
        <translation>回放</translation>
    </message>
    <message>
        <source>off</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>hold</source>
        <translation>保持</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>就绪</translation>
    </message>
    <message>
        <source>armed</source>
        <translation>已解锁</translation>
    </message>
    <message>
        <source>engaged</source>
        <translation>随动</translation>
    </message>
    <message>
        <source>emergency stop</source>
        <translation>急停</translation>
    </message>
    <message>
        <source>fault</source>
        <translation>故障</translation>
    </message>
    <message>
        <source>no fault</source>
        <translation>无故障</translation>
    </message>
    <message>
        <source>force stop</source>
        <translation>力超限停止</translation>
    </message>
    <message>
        <source>drive fault</source>
        <translation>驱动器故障</translation>
    </message>
    <message>
        <source>watchdog</source>
        <translation>看门狗</translation>
    </message>
    <message>
        <source>command stream lost</source>
        <translation>指令流丢失</translation>
    </message>
    <message>
        <source>fault %1</source>
        <translation>故障 %1</translation>
    </message>
    <message>
        <source>accepted</source>
        <translation>已接受</translation>
    </message>
    <message>
        <source>running</source>
        <translation>进行中</translation>
    </message>
    <message>
        <source>done</source>
        <translation>已完成</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>已停止</translation>
    </message>
    <message>
        <source>refused</source>
        <translation>已拒绝</translation>
    </message>
    <message>
        <source>stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>fluoroscopy</source>
        <translation>透视</translation>
    </message>
    <message>
        <source>acquisition</source>
        <translation>采集</translation>
    </message>
    <message>
        <source>spin</source>
        <translation>旋转采集</translation>
    </message>
    <message>
        <source>moving</source>
        <translation>运动中</translation>
    </message>
    <message>
        <source>SIMULATED</source>
        <translation>模拟</translation>
    </message>
    <message>
        <source>RECORDED</source>
        <translation>录制</translation>
    </message>
    <message>
        <source>NO PICTURE</source>
        <translation>无图像</translation>
    </message>
    <message>
        <source>AGE UNKNOWN</source>
        <translation>时龄未知</translation>
    </message>
    <message>
        <source>FROZEN</source>
        <translation>已冻结</translation>
    </message>
    <message>
        <source>low</source>
        <translation>低</translation>
    </message>
    <message>
        <source>medium</source>
        <translation>中</translation>
    </message>
    <message>
        <source>high</source>
        <translation>高</translation>
    </message>
    <message>
        <source>note</source>
        <translation>备注</translation>
    </message>
    <message>
        <source>link</source>
        <translation>链路</translation>
    </message>
    <message>
        <source>permit</source>
        <translation>许可</translation>
    </message>
    <message>
        <source>alarm</source>
        <translation>报警</translation>
    </message>
    <message>
        <source>operator</source>
        <translation>操作者</translation>
    </message>
    <message>
        <source>trouble</source>
        <translation>异常</translation>
    </message>
    <message>
        <source>ROADMAP</source>
        <translation>路图</translation>
    </message>
    <message>
        <source>observer</source>
        <translation>观察者</translation>
    </message>
    <message>
        <source>report of its state</source>
        <translation>状态报告</translation>
    </message>
    <message>
        <source>report of its drives</source>
        <translation>驱动器报告</translation>
    </message>
    <message>
        <source>limits of its axes</source>
        <translation>各轴限位</translation>
    </message>
    <message>
        <source>position of the tip</source>
        <translation>头端位置</translation>
    </message>
    <message>
        <source>report of beam and dose</source>
        <translation>射线与剂量报告</translation>
    </message>
    <message>
        <source>picture</source>
        <translation>图像</translation>
    </message>
</context>
<context>
    <name>console::XrayMark</name>
    <message>
        <source>X-ray beam</source>
        <translation>X 射线束</translation>
    </message>
    <message>
        <source>X-RAY ON</source>
        <translation>X 射线开</translation>
    </message>
    <message>
        <source>X-ray off</source>
        <translation>X 射线关</translation>
    </message>
    <message>
        <source>X-ray unknown</source>
        <translation>X 射线未知</translation>
    </message>
</context>
</TS>
