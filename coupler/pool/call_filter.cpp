// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/call_filter.hpp"

#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace polargrain::coupler {

#if defined(__x86_64__)

namespace {

constexpr std::array kRefused{
    // other programs and other processes
    SYS_execve, SYS_execveat, SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_pidfd_getfd,
    SYS_pidfd_send_signal, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo, SYS_tkill,
    // the file system and namespaces
    SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_unshare, SYS_setns, SYS_move_mount, SYS_open_tree,
    SYS_truncate, SYS_chmod, SYS_fchmodat, SYS_chown, SYS_lchown, SYS_fchownat, SYS_fsopen, SYS_fsconfig,
    SYS_fsmount, SYS_mount_setattr, SYS_open_by_handle_at, SYS_quotactl,
    // the kernel and the machine
    SYS_init_module, SYS_finit_module, SYS_delete_module, SYS_kexec_load, SYS_kexec_file_load, SYS_bpf,
    SYS_reboot, SYS_swapon, SYS_swapoff, SYS_sethostname, SYS_setdomainname, SYS_settimeofday,
    SYS_clock_settime, SYS_adjtimex, SYS_clock_adjtime, SYS_acct, SYS_iopl, SYS_ioperm, SYS_add_key,
    SYS_keyctl, SYS_request_key, SYS_userfaultfd,
    // which does what is refused here by another way
    SYS_io_uring_setup};

sock_filter load(std::size_t place) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(place));
}
sock_filter if_equal(std::int64_t value, std::uint8_t then, std::uint8_t otherwise) {
  return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(value), then, otherwise);
}
sock_filter end_with(std::uint32_t action) {
  return BPF_STMT(BPF_RET | BPF_K, action);
}

constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
constexpr std::size_t kNumber = offsetof(seccomp_data, nr);
constexpr std::size_t kFirstArgument =
    offsetof(seccomp_data, args);  // its low half: these machines are little-endian

/// A call that is allowed with one value of its first argument alone.
void allow_only(std::vector<sock_filter>& program, long call, std::int64_t argument) {
  program.insert(program.end(), {if_equal(call, 0, 4), load(kFirstArgument), if_equal(argument, 1, 0),
                                 end_with(kRefuse), end_with(SECCOMP_RET_ALLOW)});
}

}  // namespace

bool install_call_filter(bool may_use_network) {
  constexpr std::uint32_t kOtherInterface = 0x40000000;  // the x32 interface has numbers of its own
  std::vector<sock_filter> program{load(offsetof(seccomp_data, arch)),
                                   if_equal(AUDIT_ARCH_X86_64, 1, 0),
                                   end_with(SECCOMP_RET_KILL_PROCESS),
                                   load(kNumber),
                                   BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, kOtherInterface, 0, 1),
                                   end_with(kRefuse)};
  for (const long call : kRefused) program.insert(program.end(), {if_equal(call, 0, 1), end_with(kRefuse)});
  // Namespaces come with clone too. The flags of clone3 are out of a filter's sight: the C library does without it.
  program.insert(program.end(), {if_equal(SYS_clone3, 0, 1), end_with(SECCOMP_RET_ERRNO | ENOSYS)});
  constexpr std::uint32_t kNamespaces = 0x7e020000;  // CLONE_NEWNS, CGROUP, UTS, IPC, USER, PID, NET
  program.insert(program.end(), {if_equal(SYS_clone, 0, 4), load(kFirstArgument),
                                 BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, kNamespaces, 0, 1), end_with(kRefuse),
                                 end_with(SECCOMP_RET_ALLOW)});
  allow_only(program, SYS_kill, getpid());
  allow_only(program, SYS_tgkill, getpid());
  if (!may_use_network) allow_only(program, SYS_socket, AF_UNIX);
  program.push_back(end_with(SECCOMP_RET_ALLOW));
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  // All threads, since the message library has started its own.
  return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter) == 0;
}

#else

bool install_call_filter(bool) {
  errno = ENOSYS;
  return false;
}

#endif

}  // namespace polargrain::coupler
